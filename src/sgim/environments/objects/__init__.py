"""Toys on a table, to be recognised by manipulating them (chapter 2)."""

from sgim.environments.objects.caregiver import CAREGIVERS, Caregiver, caregivers
from sgim.environments.objects.nuisances import Nuisances
from sgim.environments.objects.pictures import kept_pictures, make_pictures
from sgim.environments.objects.table import ToyTable

__all__ = [
    "CAREGIVERS",
    "Caregiver",
    "Nuisances",
    "ToyTable",
    "caregivers",
    "kept_pictures",
    "make_pictures",
]
