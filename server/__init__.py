"""The study server: command line, app, routes, services, store."""
