"""The matrix as JUnit XML: a case per cell, and one per scenario for its fault-free runs."""

import xml.etree.ElementTree as xml
from pathlib import Path

from reed_tools.show import junit_xml
from reed_tools.text import plain

FILE = "junit.xml"


def write(folder: Path, result: dict) -> Path:
    suite = xml.Element("testsuite", name="faults")
    for row in result["rows"]:
        case = xml.SubElement(suite, "testcase", classname=f"faults.{row['scenario']}.{row['phase']}", name=f"{row['fault']} seed {row['seed']}")
        xml.SubElement(case, "system-out").text = plain(f"{row['class']}, detected by {row['detected_by']}\n{row['command']}", keep="\n")
        if row["failure"]:
            xml.SubElement(case, "error" if row["class"] == "died" else "failure", message=plain(row["failure"]))
    case = xml.SubElement(suite, "testcase", classname="faults", name="no false alarm")
    if result["false_alarms"]:
        xml.SubElement(case, "failure", message=plain(str(result["false_alarms"][0])))
    return junit_xml.write(folder / FILE, suite)
