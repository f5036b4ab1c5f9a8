"""The server and the browser that these tests share."""

import pytest

pytest.register_assert_rewrite("tests.browser.checks")

from tests.browser.fixtures import browser, context, phone, player, stage  # noqa: E402, F401
