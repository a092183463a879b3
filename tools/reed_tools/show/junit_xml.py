"""JUnit XML: a suite of test cases with its counts, as CI servers read it."""

import xml.etree.ElementTree as xml
from pathlib import Path


def write(path: Path, suite: xml.Element) -> Path:
    """`suite`: its cases; their number and those that failed are counted here."""
    cases = suite.findall("testcase")
    for count, found in (("tests", cases), ("failures", suite.findall("testcase/failure")), ("errors", suite.findall("testcase/error"))):
        suite.set(count, str(len(found)))
    xml.indent(suite)
    xml.ElementTree(suite).write(path, encoding="utf-8", xml_declaration=True)
    return path
