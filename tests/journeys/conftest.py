"""The server and the browser that these tests share."""

from tests.browser.fixtures import browser, context, phone, player, stage  # noqa: F401
