"""tools/reed completion SHELL: the script to be sourced."""

EXAMPLE = """examples:
  source <(tools/reed completion bash)                 # in ~/.bashrc: in every shell
  source <(tools/reed completion zsh)                  # in ~/.zshrc, behind compinit"""


def add_arguments(parser) -> None:
    parser.add_argument("shell", choices=("bash", "zsh"), metavar="SHELL", help="bash or zsh")


def run(arguments) -> int:
    from reed_tools.completion import bash, words, zsh  # the parsers of all commands: not for the options of this one

    print((bash if arguments.shell == "bash" else zsh).script(words.commands()), end="")
    return 0
