"""A picture that was drawn when its fields were at hand: a record keeps no fields to draw again."""

from contact_scene.reading.description import Description


class Picture(Description):
    """A drawing, shown as an image, in which nothing can run.

    svg  the whole file; its own colours on white
    """

    name: str
    title: str
    caption: str
    """What is seen, in words: also read out to those who do not see it."""

    svg: str
