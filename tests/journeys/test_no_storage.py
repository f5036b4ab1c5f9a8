"""A browser that keeps nothing: the page works, sends at once, and claims nothing that is not true."""

import pytest

from .record import chosen, must_be_whole

pytestmark = pytest.mark.browser

BLOCKED = {
    "missing": "Object.defineProperty(window, 'indexedDB', { value: undefined })",
    "forbidden": "Object.defineProperty(window, 'indexedDB',"
    " { get() { throw new DOMException('no', 'SecurityError'); } })",
    "refused": "IDBFactory.prototype.open = function () { const request = {};"
    " setTimeout(() => request.onerror?.(new Event('error'))); return request; }",
    "silent": "IDBFactory.prototype.open = () => ({})",
    "full": "IDBObjectStore.prototype.put = function () { this.transaction.abort(); }",
}


@pytest.mark.parametrize("how", BLOCKED)
def test_works_without_storage(stage, player, how):
    page = player.page
    page.add_init_script(BLOCKED[how])
    player.begin(stage.link("small"))
    player.choose(1, 4, best=4).next().wait_generation("Generation 1 of")
    player.choose(2).next().wait_generation("Generation 2 of").choose(0).next()
    player.rate(6, 2)
    page.get_by_role("heading", name="You have finished").wait_for()
    must_be_whole(stage, page)


@pytest.mark.parametrize("how", ["missing", "full"])
def test_says_that_only_the_page_keeps_the_answer(stage, player, how):
    page = player.page
    page.add_init_script(BLOCKED[how])
    player.begin(stage.link("small"))
    page.context.set_offline(True)
    player.choose(3).next()
    page.get_by_role("heading", name="Your answer is kept on this page").wait_for()
    assert "device" not in page.locator("#panel").inner_text() + player.status()
    page.context.set_offline(False)
    player.wait_generation("Generation 1 of")
    assert chosen(stage, page) == [0]
