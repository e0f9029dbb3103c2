"""links.py ROOT: every link of the README and the guide leads to a file, and every anchor to a heading."""
import pathlib
import re
import sys


def anchors(page):
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in re.findall(r"^#+ (.*)$", text, re.M)}


root = pathlib.Path(sys.argv[1])
pages = [root / "README.md", root / "CHANGELOG.md", *sorted((root / "harness/guide").glob("*.md"))]
wrong, links = [], 0
for page in pages:
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
    for file, anchor in re.findall(r"\]\(([^)#\s]*)#?([^)\s]*)\)", text):
        if "://" in file:
            continue
        links += 1
        target = page.parent / file if file else page
        if not target.exists():
            wrong.append(f"{page.relative_to(root)}: {file}: no such file")
        elif anchor and anchor not in anchors(target):
            wrong.append(f"{page.relative_to(root)}: {file}#{anchor}: no such heading")
    if page.parent.name == "guide" and page.name != "README.md" and page.name not in (root / "harness/guide/README.md").read_text():
        wrong.append(f"{page.relative_to(root)}: the guide's index lacks it")
if len((root / "README.md").read_text().splitlines()) > 120:
    wrong.append("README.md: more than one page (120 lines)")
print("\n".join(wrong) or f"{links} links of {len(pages)} pages")
sys.exit(bool(wrong) or links < 50)
