"""Routes parse, call one service and answer."""
