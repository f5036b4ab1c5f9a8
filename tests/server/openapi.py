"""What the app says of the analyst's interface: `python -m tests.server.openapi docs/openapi.json` writes it."""

import json
import sys
from pathlib import Path
from unittest.mock import MagicMock

from server.app import create_app
from server.settings import Settings


def described():
    """The document as text."""
    app = create_app(MagicMock(settings=Settings()))
    return json.dumps(app.openapi(), indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(described(), encoding="utf-8")
