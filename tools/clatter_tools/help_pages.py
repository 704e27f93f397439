# SPDX-License-Identifier: GPL-3.0-or-later
"""`python3 -m clatter_tools.help_pages tools`: man pages of all programs and the completion of bash for `clatter`, from their help."""
import argparse
import pathlib
import re
import subprocess
import sys

from .command_line import parser
from clatter.pipeline import program
from .whole_file import whole_file

STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")


def roff(text):
    """Text for troff: no line is a request, and a hyphen is the character that a shell takes."""
    lines = text.replace("\\", r"\e").replace("-", r"\-").split("\n")
    return "\n".join(r"\&" + line if line[:1] in (".", "'") else line for line in lines)


def block(lines):
    """Lines as they are."""
    text = "\n".join(lines).strip("\n")
    return f".PP\n.nf\n{roff(text)}\n.fi\n" if text else ""


def entries(rows):
    return "".join(f".TP\n.B {roff(name)}\n{roff(meaning)}\n" for name, meaning in rows)


def rows_of(lines):
    """(name, meaning) of the help's rows: a name after two blanks, its meaning beside it or on the lines below."""
    rows = []
    for line in lines:
        found = re.match(r"  (\S.*?)(?:\s{2,}(.*))?$", line)
        if found:
            # CLI11 2.4 writes a default as " [0] ", earlier ones as "=0".
            rows.append([re.sub(r" \[(\S+)\] ?$", r"=\1", found[1]), found[2] or ""])
        elif line.strip() and rows:
            rows[-1][1] = f"{rows[-1][1]} {line.strip()}".strip()
    return rows


def parts_of(text):
    """(summary, usage, {heading: rows}, free lines) of a stage's --help."""
    lines = text.rstrip("\n").split("\n")
    summary = lines[0]
    usage = next(line for line in lines if line.startswith("Usage: ")).removeprefix("Usage: ")
    sections, free, heading = {}, [], None
    for line in lines[2:]:
        begins = re.match(r"(Positionals|Options|Commands)\b.*:$", line)
        if begins:
            heading = begins[1]
            sections[heading] = []
        elif heading and (line.startswith("  ") or not line):
            sections[heading].append(line)
            heading = heading if line else None
        else:
            heading = None
            free.append(line)
    return summary, usage, {name: rows_of(found) for name, found in sections.items()}, free


def help_of(*words):
    return subprocess.run([program(words[0]), *words[1:], "--help"], capture_output=True, text=True, check=True).stdout


def version():
    return subprocess.run([program("clatter-mesh"), "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]


def page_of_stage(name):
    """The man page of a stage's program with all its commands."""
    summary, usage, sections, free = parts_of(help_of(name))
    commands = [command for command, _ in sections.get("Commands", [])]
    text = (f'.TH {name.upper()} 1 "" "clatter {version()}" "User Commands"\n.\\" Written by `make help-pages` from {name} --help.\n'
            f".SH NAME\n{name} \\- {roff(summary.rstrip('.'))}\n.SH SYNOPSIS\n.B {roff(usage)}\n")
    for heading in ("Positionals", "Options", "Commands"):
        if sections.get(heading):
            text += f".SH {heading.upper()}\n{entries(sections[heading])}"
    if any(free):
        text += f".SH DESCRIPTION\n{block(free)}"
    for command in commands:
        meaning, usage, own, rest = parts_of(help_of(name, command))
        text += f".SH COMMAND {command.upper()}\n{roff(meaning)}\n.PP\n.B {roff(usage)}\n"
        own_options = [row for row in own.get("Options", []) if row not in sections["Options"]]
        text += entries(own.get("Positionals", [])) + entries(own_options) + block(rest)
    return f"{text}.SH SEE ALSO\n{see_also(name)}"


def see_also(name):
    others = [one for one in ["clatter", *(f"clatter-{stage}" for stage in STAGES)] if one != name]
    return "".join(f".BR {roff(one)} (1){',' if one != others[-1] else ''}\n" for one in others)


def commands():
    """{name: its parser} of `clatter`."""
    return next(action for action in parser()._actions if isinstance(action, argparse._SubParsersAction)).choices


def value_of(action):
    """What follows an option: its choices, or its placeholder; empty for a flag."""
    if action.nargs == 0:
        return ""
    return "|".join(map(str, action.choices)) if action.choices else action.metavar or action.dest.upper()


def words_of(action):
    """"[--kind part|slap|drive]", "file.h5 ..."."""
    many = " ..." if action.nargs in ("+", "*") else ""
    if not action.option_strings:
        words = value_of(action) + many
        return f"[{words}]" if action.nargs in ("?", "*") else words
    words = f"{action.option_strings[0]} {value_of(action)}".strip() + many
    return words if action.required else f"[{words}]"


def own_actions(one):
    return [action for action in one._actions if action.dest != "help"]


def synopsis():
    usages = {name: roff(" ".join(map(words_of, own_actions(one)))) for name, one in commands().items()}
    return ".br\n".join(f".B clatter {roff(name)}\n{usage}\n" for name, usage in usages.items())


def options():
    text = ""
    for name, one in commands().items():
        rows = [(f"{', '.join(action.option_strings)} {value_of(action)}".strip(), action.help % vars(action))
                for action in own_actions(one) if action.help]
        text += f".SS clatter {roff(name)}\n{entries(rows)}" if rows else ""
    return text


def with_regions(text, regions):
    """The page with what stands between its lines `.\\" begin NAME` and `.\\" end` replaced."""
    for name, own in regions.items():
        text = re.sub(rf'(^\.\\" begin {name}\n).*?(^\.\\" end\n)', lambda found: found[1] + own + found[2], text, flags=re.M | re.S)
    return text


def completion():
    """The completion of bash: commands, options, and the values of options that have a choice; else file names."""
    lines = []
    for name, one in commands().items():
        actions = own_actions(one)
        for action in actions:
            if action.option_strings and action.choices:
                options = "|".join(f"{name}:{option}" for option in action.option_strings)
                lines.append(f'    {options}) words="{" ".join(map(str, action.choices))}" ;;')
        flags = [option for action in actions for option in action.option_strings]
        choices = [str(choice) for action in actions if not action.option_strings and action.choices for choice in action.choices]
        lines.append(f'    {name}:*) words="{" ".join(choices)}"; [[ $word == -* ]] && words="{" ".join([*flags, "--help"])}" ;;')
    return (f"""# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of bash for clatter, written by `make help-pages`.
_clatter() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words
  case ${{COMP_WORDS[1]}}:${{COMP_WORDS[COMP_CWORD - 1]}} in
    *:clatter|*:*/clatter) words="{' '.join(commands())} --help --version" ;;
""" + "\n".join(lines) + """
  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o bashdefault -o default -F _clatter clatter
""")


def pages(folder):
    """{path below tools/: text} of all pages; `folder` has the page of `clatter` with its text by hand."""
    found = {f"man/clatter-{stage}.1": page_of_stage(f"clatter-{stage}") for stage in STAGES}
    own = (folder / "man/clatter.1").read_text(encoding="utf-8")
    found["man/clatter.1"] = with_regions(own, {"synopsis": synopsis(), "options": options()})
    found["completion/clatter"] = completion()
    return found


if __name__ == "__main__":
    top = pathlib.Path(sys.argv[1])
    for path, text in pages(top).items():
        with whole_file(top / path) as written:
            written.write_text(text, encoding="utf-8")
