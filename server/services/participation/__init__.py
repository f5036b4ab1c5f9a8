"""Somebody takes part: arrival, place, steps, answers, the search behind them, and leaving."""
