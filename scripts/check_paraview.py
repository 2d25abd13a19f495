"""Opens what `gem export` wrote in ParaView itself, and compares three frames with the run file: cells, points, arrays, bounds.

usage: pvpython --force-offscreen-rendering scripts/check_paraview.py RUN.h5 FILM.pvd      exit code 1: wrong

By hand: the package python3-paraview takes 1 GB, and on Debian it replaces python3-vtk9. scripts/check_export.py does more, with VTK.
"""
import sys

import h5py
import numpy
from paraview.servermanager import Fetch
from paraview.simple import GetParaViewVersion, PVDReader

FLOES = ["floe", "class", "thickness", "mass", "velocity", "speed", "spin"]


def blocks_of(data):
    """Data of each part of the film by its name."""
    found = {}
    for i in range(data.GetNumberOfBlocks()):
        block = data.GetBlock(i)
        while block is not None and block.IsA("vtkMultiBlockDataSet"):
            block = block.GetBlock(0)
        found[data.GetMetaData(i).Get(data.NAME())] = block
    return found


def corners_of(run, frame):
    """Corners of all active floes in the world [m]."""
    ends = numpy.cumsum(run["shape/vertex_count"][...])
    outlines = numpy.split(run["shape/vertex_xy"][...], ends[:-1])
    x, y, theta, active = (run[f"floes/{name}"][frame].astype(float) for name in ("x", "y", "theta", "active"))
    corners = []
    for i in numpy.flatnonzero(active):
        c, s = numpy.cos(theta[i]), numpy.sin(theta[i])
        corners.append(outlines[i] @ numpy.array([[c, s], [-s, c]]) + [x[i], y[i]])
    return numpy.concatenate(corners)


def check_frame(blocks, run, frame):
    floes, platform, track = blocks["floes"], blocks["platform"], blocks["track"]
    corners = corners_of(run, frame)
    assert floes.GetNumberOfCells() == run["floes/active"][frame].sum(), "floes"
    assert floes.GetNumberOfPoints() == len(corners), "corners"
    wanted = [corners[:, 0].min(), corners[:, 0].max(), corners[:, 1].min(), corners[:, 1].max()]
    assert numpy.allclose(floes.GetBounds()[:4], wanted, rtol=1e-7, atol=1e-6), (floes.GetBounds(), wanted)
    cells = floes.GetCellData()
    assert [cells.GetArrayName(i) for i in range(cells.GetNumberOfArrays())] == FLOES, "arrays"
    speed = numpy.hypot(run["floes/vx"][frame], run["floes/vy"][frame])[run["floes/active"][frame] == 1]
    low, high = cells.GetArray("speed").GetRange()
    assert numpy.allclose([low, high], [speed.min(), speed.max()], rtol=1e-6), "speeds"
    assert platform.GetNumberOfPoints() == len(run["shape/platform_xy"]), "platform"
    assert track.GetNumberOfPoints() == len(run["platform/time"]), "track"
    return f"{floes.GetNumberOfCells()} floes, {len(corners)} corners"


def main():
    run_file, film = sys.argv[1:3]
    reader = PVDReader(FileName=film)
    reader.UpdatePipelineInformation()
    with h5py.File(run_file, "r") as run:
        times = run["floes/time"][...]
        assert list(reader.TimestepValues) == list(times), "times"
        for frame in (0, len(times) // 2, len(times) - 1):
            reader.UpdatePipeline(times[frame])
            print(f"t = {times[frame]:g} s: {check_frame(blocks_of(Fetch(reader)), run, frame)}")
    print(f"ParaView {GetParaViewVersion()}: {len(times)} frames; cells, points, arrays and bounds of three are the run's")


if __name__ == "__main__":
    main()
