# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures from artefacts: one function per picture, one style for all."""
from . import accelerations, distortion, drive, faces, film, gap, gasket, loop, piston, quality, radiation, shape, speed, stribeck, style, tensioner, valves

PICTURES = {
    "piston": piston.draw,
    "film": film.draw,
    "gap": gap.draw,
    "gasket": gasket.draw,
    "acceleration": accelerations.draw,
    "distortion": distortion.draw,
    "power": radiation.draw,
    "mesh": shape.draw_mesh,
    "faces": faces.draw,
    "quality": quality.draw,
    "shape": shape.draw_deflection,
    "drive": drive.draw,
    "loop": loop.draw,
    "speed": speed.draw,
    "stribeck": stribeck.draw,
    "tensioner": tensioner.draw,
    "valves": valves.draw,
}


def draw(kind, files, output, **options):
    """Draws one picture of PICTURES from files into a PNG or SVG; `options` are those of its function."""
    style.apply()
    figure = PICTURES[kind](files, **options)
    style.save(figure, output)
