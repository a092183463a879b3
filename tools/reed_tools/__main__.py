import sys

from reed_tools.cli import main

sys.exit(main(sys.argv[1:]))
