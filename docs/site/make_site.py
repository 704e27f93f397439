# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the site build/docs from the repository's documents and, by Doxygen, its headers; `make docs` runs it."""
import html
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

import check
import documents
import links
import navigation

SOURCE = Path(__file__).resolve().parents[2]
HERE = SOURCE / "docs/site"
SITE = SOURCE / "build/docs"


def repository_files():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=SOURCE, capture_output=True, text=True)
    if listed.returncode == 0 and listed.stdout:
        return [path for path in listed.stdout.splitlines() if (SOURCE / path).is_file()]
    found = [path.relative_to(SOURCE) for path in SOURCE.rglob("*") if path.is_file()]
    return [path.as_posix() for path in found if path.parts[0] not in ("build", ".git", ".cache")]


def write(page, text):
    path = SITE / page
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def remove_empty_summaries():
    """Doxygen 1.9.4 links the list of nested classes of a class whose nested classes are all private."""
    for page in (SITE / "api").glob("class*.html"):
        text = page.read_text(encoding="utf-8")
        if 'href="#nested-classes"' in text and 'name="nested-classes"' not in text:
            page.write_text(re.sub(r'<a href="#nested-classes">[^<]*</a>( &#124;)?\s*', "", text), encoding="utf-8")


def make_reference():
    """Runs Doxygen; returns {header: its page}. Ends the program when Doxygen warns."""
    write("header.html", navigation.doxygen_header())
    write("footer.html", navigation.DOXYGEN_FOOTER)
    if subprocess.run(["doxygen", "docs/site/Doxyfile"], cwd=SOURCE, check=False).returncode:
        sys.exit("make docs: Doxygen warns about the headers; a word that it takes for a command belongs in `backticks`")
    remove_empty_summaries()
    tags = xml.etree.ElementTree.parse(SITE / "api.tag").getroot()
    for name in ("header.html", "footer.html", "api.tag", "api/index.html"):  # the last one is empty
        (SITE / name).unlink()
    return {file.findtext("path") + file.findtext("name"): "api/" + file.findtext("filename")
            for file in tags.findall("compound[@kind='file']")}


def make_documents(translated):
    for document in navigation.documents():
        title, sections, body = documents.rendered(document, (SOURCE / document).read_text(encoding="utf-8"), translated)
        page = navigation.page_of(document)
        write(page, navigation.framed(page, title, body, sections))
    for path in translated.copied:
        shutil.copyfile(SOURCE / path, SITE / path)
    for path in translated.sources:
        text = html.escape((SOURCE / path).read_text(encoding="utf-8"))
        page = path + ".html"
        write(page, navigation.framed(page, path, f"<h1>{path}</h1>\n<pre>{text}</pre>\n"))


def main():
    shutil.rmtree(SITE, ignore_errors=True)
    SITE.mkdir(parents=True)
    shutil.copyfile(HERE / "site.css", SITE / "site.css")
    translated = links.Links(repository_files(), make_reference())
    make_documents(translated)
    wrong = check.problems(SITE)
    if wrong:
        sys.exit("\n".join(wrong) + f"\nmake docs: {len(wrong)} links lead nowhere")
    print(f"{len(navigation.documents())} documents, {len(translated.sources)} files, {len(translated.headers)} headers: "
          f"{(SITE / 'index.html').relative_to(SOURCE)}")


if __name__ == "__main__":
    main()
