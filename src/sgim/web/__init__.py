"""The page where a person watches and teaches (``pip install 'sgim[web]'``)."""

from sgim.web.server import Served, serve

__all__ = ["Served", "serve"]
