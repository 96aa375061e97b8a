#!/usr/bin/env python3
"""Manual pages and completions from what `ambrig --help` says.

    packaging/man_pages.py PROGRAM FOLDER

writes FOLDER/man1/ambrig.1, FOLDER/man1/ambrig-COMMAND.1, FOLDER/ambrig.bash and FOLDER/_ambrig (zsh)."""
import pathlib
import re
import subprocess
import sys


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout


def commands_of(text):
    """Command -> its line of the help."""
    part = re.split(r"^[Ss]ubcommands:\n", text, flags=re.M)[1].split("\n\n")[0]
    part = re.sub(r"\n {3,}", " ", part)  # a line that goes on
    return dict(re.findall(r"^  ([a-z]+)(?:, [a-z]+)* +(\S.*)$", part, re.M))


def options_of(text):
    return sorted({o for line in re.findall(r"^  (?:-\w,)?(--[\w,-]+)", text, re.M) for o in line.split(",")
                   if o.startswith("--")})


def escaped(text):
    """Verbatim in roff: backslashes, minus signs, and lines that begin with a control character."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


def page(name, summary, text, see, version):
    return (f'.TH {name.upper()} 1 "" "{version}" "User Commands"\n.SH NAME\n{escaped(name)} \\- {escaped(summary)}\n'
            f".SH DESCRIPTION\n.nf\n{escaped(text.rstrip())}\n.fi\n.SH SEE ALSO\n{escaped(see)}\n")


def bash(commands, options):
    cases = "".join(f'    {c}) words="{" ".join(o)}" ;;\n' for c, o in options.items())
    return f"""# Completion of ambrig for bash.
_ambrig() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words=""
  if [ "$COMP_CWORD" = 1 ]; then
    COMPREPLY=($(compgen -W "{' '.join(commands)} --help --version" -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}}" in
{cases}  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -o filenames -F _ambrig ambrig
"""


def zsh(commands, options):
    quoted = " ".join("'%s:%s'" % (c, s.replace("'", "").replace(":", "\\:")) for c, s in commands.items())
    cases = "".join(f"  {c}) compadd -- {' '.join(o)} ;;\n" for c, o in options.items())
    return f"""#compdef ambrig
# Completion of ambrig for zsh.
local -a commands=({quoted})
if (( CURRENT == 2 )); then
  _describe 'command' commands
  return
fi
[[ $words[CURRENT] == -* ]] && case $words[2] in
{cases}esac
_files
"""


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    (folder / "man1").mkdir(parents=True, exist_ok=True)
    text = help_of(program)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    commands = commands_of(text)
    if len(commands) < 10:
        sys.exit(f"{program} --help: only {len(commands)} commands found")
    options = {}
    for command, summary in commands.items():
        own = help_of(program, command)
        options[command] = options_of(own)
        (folder / "man1" / f"ambrig-{command}.1").write_text(page(f"ambrig-{command}", summary, own, "ambrig(1)", version))
    summary = "magnetic-bearing rigs with redundant actuators: simulate, break, compare, explain"
    (folder / "man1" / "ambrig.1").write_text(
        page("ambrig", summary, text, ", ".join(f"ambrig-{c}(1)" for c in commands), version))
    (folder / "ambrig.bash").write_text(bash(commands, options))
    (folder / "_ambrig").write_text(zsh(commands, options))


if __name__ == "__main__":
    main()
