"""A sample of tests/endurance/damaged_files.py: whichever bytes of a finished file are damaged, each program reports it in
one line, or shows the correct contents. test_damaged_files_of_more_kinds.py has those of the other kinds."""

import random

import pytest

import damaged_files
from damaged_files import Damage

SEED = 31
KINDS = ("map with starts", "sweep", "trace")  # that have the most, and the least, in common with the others
MORE_KINDS = [kind for kind in damaged_files.KINDS if kind not in KINDS]


@pytest.fixture(scope="module", params=KINDS)
def readers(request, tmp_path_factory):
    return damaged_files.Readers(tmp_path_factory.mktemp("damaged"), request.param)


def heap_of_texts(content):
    """Offset of the first collection of HDF5's global heap, which has no checksum of its own."""
    return content.index(b"GCOL")


def with_byte(content, place, value):
    return Damage(f"byte {place} set to {value}", content[:place] + bytes([value]) + content[place + 1:])


def hostile_heaps(content):
    """Sizes of the collection and of its first object: zero, and nearly everything. HDF5 loops or crashes."""
    heap = heap_of_texts(content)
    yield Damage("a zeroed sector of the heap", content[:heap + 512] + bytes(512) + content[heap + 1024:])
    for place in (heap + 8, heap + 9, heap + 15, heap + 24, heap + 25, heap + 31):  # sizes
        yield with_byte(content, place, 255 - content[place])


def test_a_damaged_file_is_refused_or_shown_as_it_was(readers):
    chance = random.Random(SEED)
    tried = [*hostile_heaps(readers.content), *damaged_files.damages(readers.content, 24, chance)]
    wrong = {damage.what: what for damage in tried for came, what in [readers.by_python(damage)] if came == "wrong"}
    assert wrong == {}


def test_run_refuses_it_too(readers):
    tried = list(hostile_heaps(readers.content))[::3]
    assert {damage.what: readers.by_run(damage) for damage in tried} == {damage.what: ("refused", "") for damage in tried}
