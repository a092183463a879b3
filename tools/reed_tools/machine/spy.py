"""tools/reed spy: lcm-spy with Reed's message types, on a current Java.

The stock lcm-spy script asks for a garbage collector that Java no longer has and misses its plotting library; here the
same program is started directly. A double click on a channel shows its fields, a click on a sparkline plots it.
"""

import os
import shutil
import subprocess
from pathlib import Path

from reed_tools.errors import RunError, UsageError
from reed_tools.paths import BUILD, ROOT

JAVA_SHARE = Path("/usr/share/java")
LCM_JAR, CHART_JAR = JAVA_SHARE / "lcm.jar", JAVA_SHARE / "jchart2d.jar"
TYPES_JAR = BUILD / "spy" / "reed-types.jar"
EXAMPLE = """examples:
  tools/reed spy                                       # beside a run: a double click opens a channel"""


def add_arguments(parser) -> None:
    parser.add_argument("--url", metavar="URL", help="LCM URL; default LCM_DEFAULT_URL or udpm://239.255.76.67:7667")
    parser.add_argument("--jar-only", action="store_true", help="build the jar of message types, print its path, start nothing")


def run(arguments) -> int:
    if missing := missing_packages():
        raise RunError(f"spy needs Java; sudo apt-get install {' '.join(missing)}")
    build_types_jar()
    if arguments.jar_only:
        print(TYPES_JAR)
        return 0
    if not os.environ.get("DISPLAY"):
        raise UsageError("lcm-spy opens a window and DISPLAY is not set; try `ssh -X`, or `xvfb-run tools/reed spy`")
    return subprocess.run(java_command(arguments.url)).returncode


def java_command(url: str | None) -> list[str]:
    classpath = ":".join(str(jar) for jar in (LCM_JAR, CHART_JAR, TYPES_JAR))
    # IPv4 first: Java would otherwise join the group on an IPv6 socket and hear nothing. -ea: as the stock script.
    command = ["java", "-Djava.net.preferIPv4Stack=true", "-Xmx128m", "-ea", "-cp", classpath, "lcm.spy.Spy"]
    return [*command, f"--lcm-url={url}"] if url else command


def missing_packages() -> list[str]:
    needed = {"default-jre": shutil.which("java"), "default-jdk-headless": shutil.which("javac"),
              "liblcm-java": LCM_JAR.exists(), "libjchart2d-java": CHART_JAR.exists()}
    return [package for package, found in needed.items() if not found]


def build_types_jar() -> None:
    """Java classes of lcmtypes/*.lcm; only when a .lcm file is newer than the jar."""
    sources = sorted((ROOT / "lcmtypes").glob("*.lcm"))
    if TYPES_JAR.exists() and TYPES_JAR.stat().st_mtime > max(path.stat().st_mtime for path in sources):
        return
    work = TYPES_JAR.parent
    shutil.rmtree(work, ignore_errors=True)
    generated, classes = work / "java", work / "classes"
    generated.mkdir(parents=True)
    classes.mkdir()
    call("lcm-gen", "--java", f"--jpath={generated}", *map(str, sources))
    call("javac", "-nowarn", "-Xlint:none", "-cp", str(LCM_JAR), "-d", str(classes), *map(str, generated.rglob("*.java")))
    call("jar", "cf", str(TYPES_JAR), "-C", str(classes), ".")


def call(*command: str) -> None:
    done = subprocess.run(command, capture_output=True, text=True, errors="replace")
    if done.returncode != 0:
        raise RunError(f"{command[0]} failed: {(done.stderr or done.stdout).strip()}")
