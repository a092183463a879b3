"""tools/reed decode: frames of the bus in engineering units, live or recorded."""

from reed_tools.errors import UsageError

EXAMPLE = """examples:
  tools/reed decode                                    # live, on vcan0 or the software bus, until Ctrl-C
  tools/reed decode out/RUN --message SYNC             # recorded frames, those of one message
  candump -L can0 | tools/reed decode -                # whatever candump prints"""


def add_arguments(parser) -> None:
    parser.add_argument("source", nargs="?", metavar="RUN_DIR|FILE|-", help="a run folder, a candump -L file, or - for standard input; "
                        "without it frames are taken from --bus")
    parser.add_argument("--bus", default="auto", metavar="BUS", help="auto (vcan if it exists, else udp), socketcan:IFACE, udp[:GROUP:PORT]")
    parser.add_argument("--message", action="append", default=[], metavar="NAME", help="only this message of the DBC; repeatable")
    parser.add_argument("--count", type=int, metavar="N", help="end after N frames")
    parser.add_argument("--duration", type=float, metavar="S", help="end a live session after S seconds")
    parser.add_argument("--json", action="store_true", help="one JSON object per line; a number that is none is a string")


def run(arguments) -> int:
    from reed_tools.export import decode  # python-can and cantools: not before they are needed

    names = [message.name for message in decode.database().messages]
    for name in arguments.message:
        if name not in names:
            raise UsageError(f"--message {name}: allowed are {', '.join(names)}")
    for option, limit in (("count", arguments.count), ("duration", arguments.duration)):
        if limit is not None and not limit > 0:
            raise UsageError(f"--{option} {limit}: has to be above 0")
    line = decode.as_json if arguments.json else decode.as_text
    shown = 0
    for frame in decode.recorded(arguments.source) if arguments.source else decode.live(arguments.bus, arguments.duration):
        decoded = decode.decode(frame)
        if not arguments.message or decoded["message"] in arguments.message:
            print(line(decoded), flush=not arguments.source)
            shown += 1
            if shown == arguments.count:
                break
    return 0
