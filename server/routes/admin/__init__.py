"""The experimenters' pages: parse, call one service, show a template."""
