"""Checks of programs, their reports and corrections, for `irbkin check` and the language server."""
