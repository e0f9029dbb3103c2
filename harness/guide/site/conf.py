# The guide as a site: ninja guide. Sphinx with Furo and MyST, as Debian has them: search works from files, without a server, which
# that of Material for MkDocs does not; and it reads well at 390 px.
import os
import pathlib
import re

from pygments.lexers import CppLexer, PythonLexer

project = "ddem"
author = "the ddem authors"
root_doc = "README"
extensions = ["myst_parser", "sphinx_copybutton", "sphinx.ext.mathjax"]
exclude_patterns = ["site"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

html_theme = "furo"
pygments_style, pygments_dark_style = "xcode", "github-dark"  # enough contrast for small text
html_title = "ddem"
html_static_path = ["static", os.environ["DDEM_KATEX"]]
html_css_files = ["katex.min.css", "guide.css"]
html_js_files = ["guide.js"]
# Formulas are typeset by KaTeX, which is in the site: no network. Sphinx loads it where a page has formulas.
mathjax_path = "katex.min.js"
mathjax_options = {"defer": "defer"}
html_copy_source = False
html_show_search_summary = False  # it would fetch pages, which a browser refuses without a server
copybutton_exclude = ".linenos, .gp"

PAGES = ["tutorial", "schemes", "accuracy", "scenes", "calibrating", "nights", "solvers", "measure", "lammps", "files", "notebooks", "scene",
         "theory", "troubleshooting", "contributing"]


def prepare(app, docname, source):
    """The first page lists all others; folders, which a site has not got, are named and not linked."""
    text = re.sub(r"\[([^\]]+)\]\((?:\.\./)+(?:scenes|campaigns)\)", r"\1", source[0])
    if docname == root_doc:
        text += "\n```{toctree}\n:hidden:\n" + "\n".join(PAGES) + "\n```\n"
    source[0] = text


def without_server(app, exception):
    """The theme of Debian 12 takes a style sheet from the root of a web server, and its script is a module that is not called one."""
    if exception:
        return
    static = pathlib.Path(app.outdir, "_static")
    sheet, script = static / "styles/furo.css", static / "scripts/furo.js"
    sheet.write_text(sheet.read_text().replace("@import url(/javascript/normalize.css/normalize.css);", ""))
    if script.read_text().lstrip().startswith("import "):
        script.write_text("")


def setup(app):
    # What marks text for a test.
    app.add_lexer("registry", CppLexer)
    app.add_lexer("pvpython", PythonLexer)
    app.connect("source-read", prepare)
    app.connect("build-finished", without_server)
