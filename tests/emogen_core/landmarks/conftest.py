"""The bundled head and its bank, made once."""

import pytest

from emogen_core.face.bundled import load_bundled_rig
from emogen_core.landmarks.bank import bank_genes, make_bank
from emogen_core.rigs.landmark_head import driven_head


@pytest.fixture(scope="session")
def head():
    return driven_head(load_bundled_rig())


@pytest.fixture(scope="session")
def bank(head):
    return make_bank(head, bank_genes(head.rig))
