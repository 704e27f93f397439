# SPDX-License-Identifier: GPL-3.0-or-later
"""A Markdown document as HTML."""
import re

from markdown_it import MarkdownIt
from markdown_it.token import Token

import links


def with_links(document, inline, translated):
    """The tokens of a line of text, with links as the site has them; a file named as code becomes a link."""
    inside = False
    for token in inline:
        if token.type == "link_open":
            inside = True
            token.attrSet("href", translated.href(document, token.attrGet("href")))
        elif token.type == "link_close":
            inside = False
        elif token.type == "image":
            token.attrSet("src", translated.href(document, token.attrGet("src")))
        named = translated.named(document, token.content) if token.type == "code_inline" and not inside else None
        if named:
            yield from (Token("link_open", "a", 1, attrs={"href": named}), token, Token("link_close", "a", -1))
        else:
            yield token


def rendered(document, text, translated):
    """(title, [(anchor, heading)] of the second level, HTML) of a document; `translated` is a links.Links."""
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    tokens = parser.parse(re.sub(r"^((?:> )?)<!--.*-->\n", r"\1\n", text, flags=re.M))  # marks for tests and tools
    headings = [(token, following) for token, following in zip(tokens, tokens[1:]) if token.type == "heading_open"]
    for (token, _), anchor in zip(headings, links.slugs(following.content for _, following in headings)):
        token.attrSet("id", anchor)
    for token in tokens:
        if token.children:
            token.children = list(with_links(document, token.children, translated))
    titles = [(token.tag, token.attrGet("id"), "".join(child.content for child in following.children))
              for token, following in headings]
    sections = [(anchor, title) for tag, anchor, title in titles if tag == "h2"]
    return titles[0][2], sections, parser.renderer.render(tokens, parser.options, {})
