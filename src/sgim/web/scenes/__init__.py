"""The worlds that the page can draw and let a person lead."""

from __future__ import annotations

from sgim.web.scenes.base import Movement, Scene


def scene_of(experiment: str | None) -> Scene | None:
    """The scene of an experiment's world; None if there is none.

    Raises:
        SgimError: If a package is missing that the world needs.
    """
    match experiment:
        case "fishing" | "fishing-full" | "fishing-noisy" | "fishing-still" | "fishing-wide":
            from sgim.web.scenes.fishing import FishingScene

            return FishingScene()
        case "hockey":
            from sgim.web.scenes.hockey import HockeyScene

            return HockeyScene()
        case str(name) if name.partition("-")[0] == "throwing":
            from sgim.web.scenes.throwing import ThrowingScene

            return ThrowingScene()
    return None


__all__ = ["Movement", "Scene", "scene_of"]
