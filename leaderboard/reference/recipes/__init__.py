"""Recipes: what a benchmark's official files mean, whatever their dialect."""

from leaderboard.reference.recipes.physion import draft_physion, is_physion_file, list_physion_remotes
from leaderboard.reference.recipes.physion_definition import render_definition
from leaderboard.reference.recipes.physionpp import (
    draft_physionpp,
    is_physionpp_file,
    list_physionpp_remotes,
    render_physionpp_definition,
)
from leaderboard.reference.recipes.recipe import Draft, ImportedProperty, ImportOptions, Recipe

RECIPES = {
    recipe.name: recipe
    for recipe in (
        Recipe(
            name="physion",
            title="Physion",
            render_definition=render_definition,
            is_wanted=is_physion_file,
            list_remotes=list_physion_remotes,
            draft=draft_physion,
        ),
        Recipe(
            name="physionpp",
            title="Physion++",
            render_definition=render_physionpp_definition,
            is_wanted=is_physionpp_file,
            list_remotes=list_physionpp_remotes,
            draft=draft_physionpp,
        ),
    )
}

__all__ = ["RECIPES", "Draft", "ImportOptions", "ImportedProperty", "Recipe"]
