#!/usr/bin/env python3
"""What a picture takes on W machines, from the measured times of its tiles.

    arcus tile SCENE --tiles 0-1599/1600 --out DIR --threads 1 [--set render.samples_per_pixel=...]
    many_workers.py DIR --start-seconds 2 --write-seconds 0.05 --merge-seconds 50 --hours 100

Many small tiles are a map of the picture's cost. Larger tiles are sums of them, and more samples are a factor: --hours says how many hours
of one worker the picture shall take. Workers take the next task when they are free, as every engine does; a task costs its start once, a tile its
rendering and its writing; the merge comes after all. The efficiency is the work over the workers' time until the last tile is there, the merge
not counted; the speed-up is with the merge. Printed as a Markdown table, one row a number of tiles, one column a number of workers.
"""
import argparse
import heapq
import itertools
import json
import math
import pathlib
import struct


def tile_times(folder):
    """Seconds and box (x0, y0, x1, y1) of every tile, and the picture's size."""
    times, boxes, picture = [], [], None
    for path in sorted(pathlib.Path(folder).glob("tile_*.tile")):
        with open(path, "rb") as file:
            magic, _, length = struct.unpack("<8sII", file.read(16))
            if magic != b"arcusflm":
                raise SystemExit(f"{path}: no tile")
            file.seek(32, 1)
            header = json.loads(file.read(length))
        times.append(json.loads(header["about"])["render_seconds"])
        boxes.append(header["box"])
        picture = header["picture"]
    if not times:
        raise SystemExit(f"{folder}: no tiles")
    return times, boxes, picture


def cost_map(times, boxes, picture, factor):
    """Seconds above and left of every pixel's corner [row][column], so that the cost of a rectangle takes four lookups."""
    width, height = picture
    cost = [[0.0] * (width + 1) for _ in range(height + 1)]
    for seconds, (x0, y0, x1, y1) in zip(times, boxes):
        each = seconds * factor / ((x1 - x0) * (y1 - y0))
        for y in range(y0, y1):
            cost[y + 1][x0 + 1:x1 + 1] = [each] * (x1 - x0)
    for above, row in zip(cost, cost[1:]):
        row[:] = [a + b for a, b in zip(itertools.accumulate(row), above)]
    return cost


def boxes_of(width, height, count):
    """As tile_box in src/render/tile.cpp cuts a picture."""
    nearest = int(math.floor(math.sqrt(count * height / width) + 0.5))
    rows = min(max(nearest, -(-count // width)), min(height, count))
    first = [row * count // rows for row in range(rows + 1)]
    top = [row + (height - rows) * first[row] // count for row in range(rows + 1)]
    for row in range(rows):
        tiles = first[row + 1] - first[row]
        for column in range(tiles):
            yield width * column // tiles, top[row], width * (column + 1) // tiles, top[row + 1]


def last_finish(tasks, workers):
    """When the last of the tasks ends, each taken by the worker that is free first."""
    free = [0.0] * min(workers, len(tasks))
    for seconds in tasks:
        heapq.heapreplace(free, free[0] + seconds)
    return max(free)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--start-seconds", type=float, required=True, help="of a worker, before it renders")
    parser.add_argument("--write-seconds", type=float, required=True, help="of a tile, beside its rendering")
    parser.add_argument("--merge-seconds", type=float, required=True)
    parser.add_argument("--hours", type=float, required=True, help="of one worker, for the whole picture")
    parser.add_argument("--tiles", type=int, nargs="*", default=[250, 1000, 4000, 10000])
    parser.add_argument("--workers", type=int, nargs="*", default=[1, 2, 10, 100, 300, 1000])
    parser.add_argument("--most-tasks", type=int, default=1001, help="that the engine takes (Slurm: MaxArraySize)")
    given = parser.parse_args()
    times, boxes, picture = tile_times(given.folder)
    cost = cost_map(times, boxes, picture, given.hours * 3600 / sum(times))
    print(f"{len(times)} measured tiles: {sum(times):.1f} s, the slowest {max(times) * len(times) / sum(times):.2f} times the mean\n")
    print("| tiles | a task | a tile, mean | slowest | " + " | ".join(f"{w} workers" for w in given.workers) + " |")
    print("| ---: | ---: | ---: | ---: | " + " | ".join("---:" for _ in given.workers) + " |")
    for count in given.tiles:
        # Boxes of the measured picture; a larger one is cut alike.
        tiles = [cost[y1][x1] - cost[y0][x1] - cost[y1][x0] + cost[y0][x0] for x0, y0, x1, y1 in boxes_of(*picture, count)]
        mean = sum(tiles) / count
        a_task = max(1, math.ceil(max(60, 40 * given.start_seconds) / mean), math.ceil(count / given.most_tasks))
        # As src/farm/farm_job.cpp deals them: every so-manieth tile, from all over the picture.
        dealt = -(-count // a_task)
        tasks = [given.start_seconds + sum(tiles[i::dealt]) + given.write_seconds * len(tiles[i::dealt]) for i in range(dealt)]
        cells = []
        for workers in given.workers:
            end = last_finish(tasks, workers)
            cells.append(f"{sum(tiles) / (workers * end):.1%}, {sum(tiles) / (end + given.merge_seconds):.0f}×")
        print(f"| {count} | {a_task} | {mean:.1f} s | {max(tiles):.1f} s | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
