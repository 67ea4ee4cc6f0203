"""Figures of the website: coordinates computed here, printed by ``templates/drawings.html``."""
