"""Recipes: from a benchmark's official files, whatever their dialect, to a sealed reference."""

from leaderboard.reference.recipes.physion import import_physion
from leaderboard.reference.recipes.recipe import ImportedProperty, ImportReport, Recipe

RECIPES = {
    recipe.name: recipe
    for recipe in (Recipe("physion", "Physion, the predecessor of Physion++ (2021)", import_physion),)
}

__all__ = ["RECIPES", "ImportReport", "ImportedProperty", "Recipe"]
