"""Draw the faces of the worked example: `python -m tests.browser.example_faces` writes static/example/."""

import numpy as np
from PIL import Image

from emogen_core.correctives.pipeline import face_weights
from emogen_core.rendering.protocol import RenderSettings
from emogen_core.rendering.setup import make_renderer
from server.assets import asset

SIZE = (150, 180)
# How strong surprise is in each face: six that differ, then six bred from the chosen ones.
STRENGTHS = (0.15, 0.75, 0.5, 0.1, 0.35, 0.85, 0.75, 0.85, 0.65, 0.8, 0.3, 0.95)
OTHERS = 0.35


def main():
    renderer, rig, *_ = make_renderer("pyrender")
    settings = RenderSettings(width=2 * SIZE[0], height=2 * SIZE[1])
    pictures = renderer.draw("female", face_weights(rig, "female", _genes(rig)).weights, settings)
    renderer.close()
    folder = asset("static") / "example"
    folder.mkdir(exist_ok=True)
    for number, picture in enumerate(pictures, start=1):
        image = Image.fromarray(picture).resize(SIZE, Image.Resampling.LANCZOS)
        image.quantize(128, dither=Image.Dither.NONE).save(folder / f"{number}.png", optimize=True)


def _genes(rig):
    rng = np.random.default_rng(11)
    names = list(rig.gene_names)
    surprise = [names.index(name) for name in rig.emotion_sets["surprised"].genes]
    apart = [names.index(name) for name in rig.emotion_sets["happy"].genes]
    genes = np.zeros((len(STRENGTHS), len(names)))
    for row, strength in zip(genes, STRENGTHS, strict=True):
        row[surprise] = strength * rng.uniform(0.5, 1, len(surprise))
        row[rng.choice(apart, 2, replace=False)] = OTHERS * (1 - strength)
    return genes.clip(0, 0.99)


if __name__ == "__main__":
    main()
