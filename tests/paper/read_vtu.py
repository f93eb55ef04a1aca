#!/usr/bin/python3
"""Reads every body that a .pvd lists with VTK's own reader (Debian: python3-vtk9) and checks it.

Cells have positive volumes, now and at rest; at rest they add up to the body's volume; the array volume_ratio is the
ratio of the two. One line a .pvd. Exit codes: 0 fine, 1 a check failed, 2 wrong arguments.

    read_vtu.py --volume-mm3 786432 out/paper/*/body.pvd
"""
import argparse
import math
import pathlib
import sys
import xml.etree.ElementTree

import vtkmodules.vtkCommonDataModel  # the reader's output
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkTetra
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


class Failure(Exception):
    pass


def require(condition, message):
    if not condition:
        raise Failure(message)


def entries_of(pvd):
    """(time, path) of each data set, in order."""
    sets = xml.etree.ElementTree.parse(pvd).getroot().findall("Collection/DataSet")
    require(sets, "lists no data set")
    entries = [(float(one.get("timestep")), pvd.parent / one.get("file")) for one in sets]
    times = [time for time, _ in entries]
    require(all(a < b for a, b in zip(times, times[1:])), "times do not increase")
    return entries


def read_grid(path):
    require(path.is_file(), f"{path.name} is missing")
    errors = []
    reader = vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.GetExecutive().AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    require(not errors and reader.GetErrorCode() == 0, f"{path.name} cannot be read")
    require(grid.GetNumberOfCells() > 0, f"{path.name} has no cells")
    return grid


def check_arrays(grid, path):
    """One finite value a point or cell."""
    of_points = (grid.GetPointData(), grid.GetNumberOfPoints())
    of_cells = (grid.GetCellData(), grid.GetNumberOfCells())
    for data, count in (of_points, of_cells):
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            require(array.GetNumberOfTuples() == count, f"{path.name}: {array.GetName()} has another length")
            bounds = [bound for k in range(array.GetNumberOfComponents()) for bound in array.GetRange(k)]
            require(all(map(math.isfinite, bounds)), f"{path.name}: {array.GetName()} is not finite")


def volumes_of(grid, points, path):
    volumes = []
    for i in range(grid.GetNumberOfCells()):
        require(grid.GetCellType(i) == VTK_TETRA, f"{path.name}: cell {i} is no tetrahedron")
        ids = grid.GetCell(i).GetPointIds()
        volumes.append(vtkTetra.ComputeVolume(*(points[ids.GetId(k)] for k in range(4))))
        require(volumes[-1] > 0, f"{path.name}: cell {i} has the volume {volumes[-1]:g}")
    return volumes


def check_body(path, volume_mm3):
    """Returns its number of cells and its volume over that at rest."""
    grid = read_grid(path)
    check_arrays(grid, path)
    now = [grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]
    moved = grid.GetPointData().GetArray("displacement_mm")
    rest = [tuple(x - u for x, u in zip(now[i], moved.GetTuple(i))) for i in range(len(now))] if moved else now
    volumes = volumes_of(grid, now, path)
    rest_volumes = volumes_of(grid, rest, path)
    sum_mm3 = math.fsum(rest_volumes)
    is_whole = math.isclose(sum_mm3, volume_mm3, rel_tol=1e-9)
    require(is_whole, f"{path.name}: {sum_mm3:.9g} mm3 at rest, not {volume_mm3:.9g}")
    ratios = grid.GetCellData().GetArray("volume_ratio")
    for i in range(len(volumes) if ratios else 0):
        ratio, given = volumes[i] / rest_volumes[i], ratios.GetValue(i)
        agrees = math.isclose(ratio, given, rel_tol=1e-5)
        require(agrees, f"{path.name}: volume_ratio of cell {i} is {given}, but it is {ratio}")
    return len(volumes), math.fsum(volumes) / sum_mm3


def check_series(pvd, volume_mm3):
    entries = entries_of(pvd)
    counts, ratios = zip(*(check_body(path, volume_mm3) for _, path in entries))
    cells = f"{counts[0]}" if min(counts) == max(counts) else f"{min(counts)} to {max(counts)}"
    return (f"{len(entries)} bodies of {cells} tets, {entries[0][0]:g} to {entries[-1][0]:g} s: "
            f"{volume_mm3:g} mm3 at rest, {min(ratios) * 100:.2f} to {max(ratios) * 100:.2f} % of it as they are")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--volume-mm3", type=float, required=True, help="of the body at rest")
    parser.add_argument("pvd", type=pathlib.Path, nargs="+")
    arguments = parser.parse_args()
    failed = False
    for pvd in arguments.pvd:
        try:
            print(f"{pvd}: {check_series(pvd, arguments.volume_mm3)}")
        except (Failure, OSError, xml.etree.ElementTree.ParseError) as error:
            print(f"{pvd}: FAILED: {error}")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
