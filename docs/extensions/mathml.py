"""Equations as MathML, which browsers draw by themselves: no scripts or fonts to load."""

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml


def write_inline(writer, node):
    """An equation within a line."""
    writer.body.append(tex2mathml(node.astext()))
    raise nodes.SkipNode


def write_block(writer, node):
    """An equation that stands by itself."""
    equation = tex2mathml(node.astext(), as_block=True)
    writer.body.append(f'<div class="math-wrapper">{equation}</div>')
    raise nodes.SkipNode


def setup(app):
    """Called by Sphinx."""
    app.add_html_math_renderer("mathml", (write_inline, None), (write_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
