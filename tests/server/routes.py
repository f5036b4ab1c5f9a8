from server.app import ROUTERS


def all_routes():
    """Every method and path that the app answers, static files aside."""
    return sorted((method, route.path) for router in ROUTERS for route in router.routes for method in route.methods)
