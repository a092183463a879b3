"""A campaign as JUnit XML: its limits, whether draws repeat, then every draw. A draw fails when it is not stable or beyond
the worst allowed ratio: the same that makes the campaign fail."""

import math
import xml.etree.ElementTree as xml
from pathlib import Path

from reed_tools.campaign.definition import Campaign
from reed_tools.campaign.draws import Record, command
from reed_tools.campaign.verdicts import Verdict
from reed_tools.show import junit_xml
from reed_tools.text import plain

FILE = "junit.xml"


def write(folder: Path, campaign: Campaign, records: list[Record], verdict: Verdict) -> Path:
    suite = xml.Element("testsuite", name=f"campaign {campaign.name}")
    for limit in verdict.lines:
        case = xml.SubElement(suite, "testcase", classname=f"campaign.{campaign.name}", name=limit.name)
        if not limit.ok:
            xml.SubElement(case, "failure", message=f"{limit.value:g}, required {limit.sign} {limit.limit:g}")
    if verdict.repeated:
        case = xml.SubElement(suite, "testcase", classname=f"campaign.{campaign.name}", name="draws run twice are equal")
        if verdict.different:
            xml.SubElement(case, "failure", message=f"other digests in draws {', '.join(map(str, verdict.different))}")
    for record in records:
        case = xml.SubElement(suite, "testcase", classname=f"campaign.{campaign.name}.draw", name=f"draw {record.index}")
        xml.SubElement(case, "system-out").text = plain(
            f"worst ratio {record.ratio:.3f}, digest {record.digest}\n{command(campaign.scenario, record)}", keep="\n")
        if record.status == "died":
            xml.SubElement(case, "error", message=plain(record.message))
        elif not record.stable or record.ratio > campaign.limits["worst_ratio"]:
            xml.SubElement(case, "failure", message=plain(reason(record)))
    return junit_xml.write(folder / FILE, suite)


def reason(record: Record) -> str:
    check = record.deciding
    if not record.stable:
        return record.message or (f"not stable: {check['name']} = {check['value']}" if check else "not stable")
    times = f"{record.ratio:.2f} times its limit" if math.isfinite(record.ratio) else "beyond its limit"
    return f"{check['name']} = {check['value']:g}, {times} {check['limit']:g}"
