"""The vocal tract of chapter 5: its shape and acoustics, its motors, and how it is heard."""

from sgim.environments.vocal.articulations import articulations
from sgim.environments.vocal.goals import vocal_goals
from sgim.environments.vocal.languages import AmbientLanguage, ambient_language, spoken
from sgim.environments.vocal.world import Vocalisation, VocalTract

__all__ = [
    "AmbientLanguage",
    "VocalTract",
    "Vocalisation",
    "ambient_language",
    "articulations",
    "spoken",
    "vocal_goals",
]
