"""What an installation sets from outside: environment variables named EMOGEN_*, described in docs/settings.md."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from pydantic import Field
from pydantic_settings import BaseSettings, SettingsConfigDict


class Settings(BaseSettings):
    """Every setting with its default; a wrong value stops the start with a sentence that names it."""

    model_config = SettingsConfigDict(env_prefix="EMOGEN_", extra="ignore")

    data_dir: Path = Field(default=Path("var"), description="Folder of the SQLite database and the portrait cache.")
    database_url: str = Field(
        default="",
        description="SQLAlchemy URL; empty means SQLite in the data folder. PostgreSQL: postgresql+psycopg://...",
    )
    host: str = Field(default="127.0.0.1", description="Address to listen on.")
    port: int = Field(default=8000, ge=0, le=65535, description="Port to listen on; 0 takes a free one.")
    base_url: str = Field(
        default="",
        description="Public address, for links that are printed. With https, cookies are Secure and HSTS is sent.",
    )
    behind_proxy: bool = Field(
        default=False, description="Whether a reverse proxy in front says the scheme and address of the client."
    )
    render_workers: int = Field(default=0, ge=0, le=64, description="Drawing processes; 0 means one a core.")
    renderer: Literal["pyrender", "software"] = Field(
        default="pyrender", description="What draws portraits; software needs no OpenGL and is slow and plain."
    )
    portrait_wait_seconds: float = Field(
        default=20.0,
        gt=0,
        le=120,
        description="How long a request waits for a portrait before it is told to come again.",
    )
    portrait_memory_mb: int = Field(
        default=64, ge=1, description="Portraits kept in memory, beside those in the data folder."
    )
    body_limit_bytes: int = Field(
        default=262_144,
        ge=1024,
        description="Largest request body that is read; study files and the form of a study may have 5 MiB.",
    )
    body_timeout_seconds: float = Field(default=30.0, gt=0, description="How long a client may take to send a body.")
    session_hours: int = Field(default=12, ge=1, description="How long a sign-in to the admin pages lasts.")
    login_attempts: int = Field(
        default=5,
        ge=1,
        description="Wrong passwords for one e-mail address before it has to wait 15 minutes; 1000 for all together"
        " make everybody wait who signs in.",
    )
    redirect_hosts: str = Field(
        default="app.prolific.com,app.prolific.co,www.mturk.com,workersandbox.mturk.com,.sona-systems.com",
        description="Hosts that a study may send participants back to, with commas; .example.org stands for every host"
        " below example.org.",
    )
    joins_per_minute: int = Field(
        default=600, ge=1, description="People who may begin by one link within a minute; who comes then waits."
    )
    log_level: Literal["debug", "info", "warning", "error"] = Field(
        default="info", description="How much is written to standard error."
    )

    @property
    def url(self) -> str:
        """The database's URL, with the default filled in."""
        return self.database_url or f"sqlite:///{self.data_dir.absolute() / 'emogen.db'}"

    @property
    def address(self) -> str:
        """The public address without a slash at the end."""
        return (self.base_url or f"http://{self.host}:{self.port}").rstrip("/")

    @property
    def secure(self) -> bool:
        """Whether people reach this server by https."""
        return self.address.startswith("https://")
