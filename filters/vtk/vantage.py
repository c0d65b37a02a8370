"""Vantage: importance-driven global illumination as VTK filters."""

from .vtkVantageFilters import *
