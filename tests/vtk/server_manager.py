"""What the plugin of ParaView says of the filters is what they are: every class is there, every
property sets something and has the filter's own default, and no setting is left out."""

import sys
import xml.etree.ElementTree as xml

import vantage

# A vtkCamera is no property of ParaView, and what it sends to the filters has no 64 bits without a
# sign.
NOT_SETTINGS = {"SetCamera", "SetSeed"}
# "No limit" is another number in the panel, where one is to be typed over it.
OTHER_DEFAULTS = {("vtkPatchSubdivision", "MaximumEdgeLength"),
                  ("vtkImportanceDrivenShooting", "Steps"),
                  ("vtkImportanceDrivenShooting", "TimeLimit")}


def own_settings(instance):
    """Names of the setters that the class itself declares, with a getter beside each."""
    cls = type(instance)
    inherited = set(dir(cls.__mro__[1]))
    return {name for name in dir(cls)
            if name.startswith("Set") and name not in inherited and name not in NOT_SETTINGS
            and hasattr(cls, "Get" + name[3:])}


def values_of(element):
    """The default values of a property, as its kind says."""
    text = element.get("default_values", "")
    if element.tag == "StringVectorProperty":
        return [text]
    convert = float if element.tag == "DoubleVectorProperty" else int
    return [convert(word) for word in text.split()]


def check_property(cls, instance, element):
    """Complaints about one property."""
    name = element.get("name")
    command = element.get("command")
    setter = getattr(instance, command, None)
    if setter is None:
        return [f"{cls}.{command} does not exist"]
    values = values_of(element)
    if name == "FileName":
        return []
    if len(values) != int(element.get("number_of_elements")):
        return [f"{cls}.{name} has {len(values)} default values"]
    complaints = []
    default = getattr(instance, "Get" + name)()
    default = list(default) if isinstance(default, (tuple, list)) else [default]
    if (cls, name) not in OTHER_DEFAULTS and [type(v)(d) for v, d in zip(values, default)] != values:
        complaints.append(f"{cls}.{name} is {values} by default, not {default}")
    setter(*values)
    kept = getattr(instance, "Get" + name)()
    kept = list(kept) if isinstance(kept, (tuple, list)) else [kept]
    if [type(v)(k) for v, k in zip(values, kept)] != values:
        complaints.append(f"{cls}.{name} does not keep {values}")
    return complaints


def check_proxy(proxy):
    """Complaints about one filter."""
    cls = proxy.get("class")
    if not hasattr(vantage, cls):
        return [f"there is no class {cls}"]
    instance = getattr(vantage, cls)()
    complaints = []
    said = set()
    for element in proxy:
        if element.tag.endswith("VectorProperty"):
            said.add(element.get("command"))
            complaints += check_property(cls, instance, element)
        if element.tag == "OutputPort":
            port = int(element.get("index"))
            if port >= instance.GetNumberOfOutputPorts():
                complaints.append(f"{cls} has no output {port}")
    complaints += [f"{cls}.{name} is no property" for name in own_settings(instance) - said]
    return complaints


def main():
    proxies = xml.parse(sys.argv[1]).getroot().findall(".//SourceProxy")
    classes = {proxy.get("class") for proxy in proxies}
    algorithms = {name for name in dir(vantage)
                  if name.startswith("vtk") and hasattr(getattr(vantage, name), "GetOutputPort")}
    complaints = [f"{name} is left out" for name in algorithms - classes]
    for proxy in proxies:
        complaints += check_proxy(proxy)
    print("\n".join(complaints))
    return 1 if complaints or not proxies else 0


sys.exit(main())
