"""The portraits in memory."""

from server.services.faces.portrait_memory import PortraitMemory


def test_memory_is_bounded_and_keeps_what_was_used_last():
    memory = PortraitMemory(10)
    for number in range(5):
        memory.put(str(number), b"1234")
    assert [memory.get(str(number)) for number in range(5)] == [None, None, None, b"1234", b"1234"]
    memory.get("3")
    memory.put("5", b"1234")
    assert (memory.get("3"), memory.get("4")) == (b"1234", None)
    memory.put("3", b"12")
    memory.drop("5")
    memory.put("6", b"12345678")
    assert memory.get("3") == b"12"
