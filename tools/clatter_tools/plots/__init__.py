# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures from artefacts: one function per picture, one style for all."""
from . import accelerations, faces, film, piston, quality, radiation, shape, style

PICTURES = {
    "piston": piston.draw,
    "film": film.draw,
    "acceleration": accelerations.draw,
    "erp": radiation.draw,
    "mesh": shape.draw_mesh,
    "faces": faces.draw,
    "quality": quality.draw,
    "shape": shape.draw_deflection,
}


def draw(kind, files, output):
    """Draws one picture of PICTURES from files into a PNG, which appears only when it is complete."""
    style.apply()
    figure = PICTURES[kind](files)
    style.save(figure, output)
