"""Recognising objects in pictures with depth, learned one labelled picture at a time."""

from sgim.recognition.features import FEATURES, Eye, Features
from sgim.recognition.model import RecognitionModel
from sgim.recognition.picture import Picture, PictureError
from sgim.recognition.recogniser import (
    NothingLearnedError,
    Recogniser,
    Recognition,
    Settings,
)

__all__ = [
    "FEATURES",
    "Eye",
    "Features",
    "NothingLearnedError",
    "Picture",
    "PictureError",
    "Recogniser",
    "Recognition",
    "RecognitionModel",
    "Settings",
]
