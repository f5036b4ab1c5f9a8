"""One shape for every error: services' refusals, wrong requests, unknown addresses, faults of our own."""

from __future__ import annotations

import json
import logging
from http import HTTPStatus
from typing import TYPE_CHECKING, Any

from fastapi.exceptions import RequestValidationError
from starlette.exceptions import HTTPException
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response

from ..services.config import preferred
from ..services.errors import (
    ConflictError,
    ForbiddenError,
    InvalidError,
    NotFoundError,
    ServiceError,
    StorageError,
    ThrottledError,
    UnauthorisedError,
    UnavailableError,
)
from .admin.desk import SESSION, page
from .wanted import wanted_languages

if TYPE_CHECKING:
    from fastapi import FastAPI
    from starlette.requests import Request

    from ..texts.pages import Pages

logger = logging.getLogger(__name__)

STATUS: dict[type[ServiceError], int] = {
    NotFoundError: 404,
    InvalidError: 422,
    UnauthorisedError: 401,
    ForbiddenError: 403,
    ConflictError: 409,
    ThrottledError: 429,
    UnavailableError: 503,
}
SENTENCES = {
    400: "The request could not be read.",
    404: "There is nothing at this address.",
    405: "This address does not take this kind of request.",
    408: "The request took too long to arrive. Send it again.",
    413: "The request is larger than this server takes.",
    500: "Something failed on the server. Nothing was stored. Try again; if it stays, tell whoever runs the study.",
}
CODES = {400: "bad_request", 404: "not_found", 405: "method_not_allowed", 408: "timeout", 413: "too_large"}
PROBLEMS = {404: "unknown", 409: "closed"}
"""Which page an error gets; all others get the page for faults of our own."""
STORAGE_RETRY = 5
"""Seconds after which a request that found no room may come again."""
OWN_PAGES = frozenset({"renewed"})
"""Codes of refusals with a page of their own."""


def install(app: FastAPI) -> None:
    """Answer every error in the one shape."""
    app.add_exception_handler(ServiceError, _service)
    app.add_exception_handler(StorageError, _storage)
    app.add_exception_handler(RequestValidationError, _validation)
    app.add_exception_handler(HTTPException, _http)


def error_body(status: int, **details: Any) -> dict[str, Any]:
    """Return the one shape for a status that no service raised."""
    code = CODES.get(status, "error" if status < 500 else "internal")
    message = SENTENCES.get(status, HTTPStatus(status).phrase)
    return {"error": {"code": code, "message": message, **details}}


def answer(request: Request, status: int, body: dict[str, Any], headers: dict[str, str] | None = None) -> Response:
    """Return an error as JSON, or as a page to a browser that asked for one."""
    if request.url.path.startswith("/admin"):
        return _admin(request, status, body, headers)
    if wants_page(request):
        pages: Pages = request.app.state.pages
        problem = body["error"]["code"] if body["error"]["code"] in OWN_PAGES else PROBLEMS.get(status, "wrong")
        words = pages.catalogue(preferred(pages.languages, wanted_languages(request)))
        html = pages.render("error.html", words, problem=problem, reload=_way_on(request))
        return HTMLResponse(html, status, headers)
    return JSONResponse(body, status, headers)


def status_of(error: ServiceError) -> int:
    """Return the HTTP status of a refusal."""
    return next((code for kind, code in STATUS.items() if isinstance(error, kind)), 400)


def _admin(request: Request, status: int, body: dict[str, Any], headers: dict[str, str] | None) -> Response:
    if status == 401:
        return RedirectResponse("/admin/login", 303)
    response = page("error", status, message=body["error"]["message"], known=SESSION in request.cookies)
    response.headers.update(headers or {})
    return response


def wants_page(request: Request) -> bool:
    """Return whether the request comes from a browser's address bar or a plain form."""
    return "text/html" in request.headers.get("accept", "") and not request.url.path.startswith("/api/")


def _way_on(request: Request) -> str:
    """Return the page to try again: a form's own address takes no GET, the page that it stood on does."""
    return "/".join(request.url.path.split("/")[:3]) if request.method == "POST" else request.url.path


async def _service(request: Request, error: Exception) -> Response:
    if not isinstance(error, ServiceError):
        raise error
    status = status_of(error)
    wait = getattr(error, "retry_after", None)
    headers = {"Retry-After": str(wait)} if wait is not None else {}
    if status == 401:
        headers["WWW-Authenticate"] = "Bearer"
    return answer(request, status, error.body(), headers)


async def _storage(request: Request, error: Exception) -> Response:
    """Nothing was stored, and the same request may come again: a full disk is the server's own trouble."""
    logger.error("the database cannot be used: %s", error)
    body = UnavailableError("The server cannot store anything at the moment. Nothing was stored. Try again.").body()
    return answer(request, 503, body, {"Retry-After": str(STORAGE_RETRY)})


async def _validation(request: Request, error: Exception) -> Response:
    if not isinstance(error, RequestValidationError):
        raise error
    return answer(request, 422, validation_body(list(error.errors())))


def validation_body(problems: list[Any]) -> dict[str, Any]:
    """Return the one shape for the first of pydantic's problems."""
    first = problems[0]
    path = [str(part) for part in first["loc"] if part not in {"body", "query", "path"}]
    got = first.get("input")
    return {
        "error": {
            "code": "invalid",
            "message": f"The request cannot be used: {'.'.join(path) or 'body'}: {first['msg']}.",
            "field": ".".join(path) or "body",
            "expected": str(first["msg"]),
            "got": json.dumps(got, default=str)[:200],
        }
    }


async def _http(request: Request, error: Exception) -> Response:
    if not isinstance(error, HTTPException):
        raise error
    return answer(request, error.status_code, error_body(error.status_code), dict(error.headers or {}))
