"""Ways to damage a rig, space or look file, drawn from a generator: raw bytes, or content whose hash fits again."""

import numpy as np

from emogen_core.face.container import read_container, write_container

ODD = (None, -1, 2**31, 2**63, 1e300, 0.5, "", "nowhere", "x" * 5000, [], {}, [[]], True, ["a"], {"name": 1})
DTYPES = ("?", "u1", "i2", "i4", "i8", "u8", "f2", "f4", "f8")


def damaged_bytes(good, path, rng):
    """Flip, cut, repeat or overwrite a few bytes."""
    data = bytearray(good.read_bytes())
    for _ in range(rng.choice((1, 1, 2, 8))):
        at = rng.randrange(len(data))
        match rng.randrange(4):
            case 0:
                data[at] ^= 1 << rng.randrange(8)
            case 1:
                del data[at : at + rng.randrange(1, 64)]
            case 2:
                data[at:at] = data[at : at + rng.randrange(1, 64)]
            case _:
                data[at : at + 4] = rng.choice((b"\xff\xff\xff\xff", b"\0\0\0\0", b"\xff\xff\xff\x7f"))
        data = data or bytearray(b"\0")
    path.write_bytes(data)


def damaged_content(good, path, rng, kind, version):
    """Change the document or an array, and store that with a hash that fits."""
    document, arrays, _ = read_container(good, kind, version)
    if rng.random() < 0.5:
        _change(document, rng)
    else:
        name = rng.choice(sorted(arrays))
        arrays[name] = _changed(arrays[name], rng)
        if arrays[name] is None:
            del arrays[name]
    write_container(path, kind, version, document, arrays)


def _change(value, rng):
    """Walk down at random and put something odd there, or take something away."""
    keys = sorted(value) if isinstance(value, dict) else list(range(len(value)))
    if not keys:
        return
    key = rng.choice(keys)
    if isinstance(value[key], (dict, list)) and value[key] and rng.random() < 0.8:
        _change(value[key], rng)
    elif rng.random() < 0.2:
        del value[key]
    else:
        value[key] = rng.choice(ODD)


def _changed(array, rng):
    match rng.randrange(5):
        case 0:
            return None
        case 1:
            return array[: rng.randrange(len(array) + 1)] if array.ndim else array
        case 2:
            return array.reshape(rng.choice(((-1,), (1, -1), (-1, 1), (-1, 1, 1))))
        case 3:
            return array.astype(rng.choice(DTYPES))
        case _:
            flat = array.ravel().copy()
            if len(flat):
                flat[rng.randrange(len(flat))] = np.array(rng.choice((-1, 2**14, -(2**14), 7))).astype(flat.dtype)
            return flat.reshape(array.shape)
