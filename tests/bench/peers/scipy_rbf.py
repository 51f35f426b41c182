#!/usr/bin/env python3
"""Stretched girths by SciPy's RBFInterpolator: r^3, exact, the 80 nearest constraints.

Reads `points`, `normals` and `planes` (three control points each) from a folder, as raw float64.
The constraints are 0 at the points and the distance a spacing off along the normals, outside and
inside. On each plane the outermost zero along rays from the middle of the section is found by
regula falsi; the girth is the perimeter of the hull of these. Prints the time of one girth in ms, then
a line for each plane.
"""
import sys
import time

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial import ConvexHull, cKDTree

RAYS = 360
STEPS = 9  # of a ray, across the band that the points near the plane span
REFINEMENTS = 5
FEWEST_POINTS_OF_SECTION = 60
NEIGHBOURS = 80


def read(name):
    return np.fromfile(sys.argv[1] + "/" + name).reshape(-1, 3)


def frame(plane):
    origin, second, third = plane
    u = (second - origin) / np.linalg.norm(second - origin)
    normal = np.cross(u, third - origin)
    normal /= np.linalg.norm(normal)
    return origin, u, np.cross(normal, u), normal


def radii_of_points(angles, polar_angles, polar_radii):
    """Largest and smallest radius of the points near each ray."""
    width = 2.0 * np.pi / 60
    low, high = np.empty(len(angles)), np.empty(len(angles))
    for i, angle in enumerate(angles):
        off = np.abs((polar_angles - angle + np.pi) % (2.0 * np.pi) - np.pi)
        near = polar_radii[off < max(width, np.sort(off)[2])]
        low[i], high[i] = near.min(), near.max()
    return low, high


def girth(points, normals, spacing, plane):
    origin, u, v, normal = frame(plane)
    height = (points - origin) @ normal
    section_half_width = max(1.5 * spacing, np.sort(np.abs(height))[FEWEST_POINTS_OF_SECTION])
    slab = np.abs(height) < 5.0 * section_half_width
    near, outward = points[slab], normals[slab]
    sites = np.vstack([near, near + spacing * outward, near - spacing * outward])
    values = np.repeat([0.0, spacing, -spacing], len(near))
    field = RBFInterpolator(sites, values, neighbors=NEIGHBOURS, kernel="cubic", degree=1)

    beside = np.abs(height) < section_half_width
    flat = np.column_stack([(points[beside] - origin) @ u, (points[beside] - origin) @ v])
    middle = 0.5 * (flat.min(axis=0) + flat.max(axis=0))
    flat -= middle
    angles = 2.0 * np.pi * np.arange(RAYS) / RAYS
    low, high = radii_of_points(angles, np.arctan2(flat[:, 1], flat[:, 0]), np.hypot(*flat.T))
    margin = section_half_width
    low, high = np.maximum(low - margin, 0.0), high + margin
    rays = np.cos(angles)[:, None] * u + np.sin(angles)[:, None] * v
    centre = origin + middle[0] * u + middle[1] * v

    def at(radii):
        places = centre + radii[..., None] * rays[:, None, :] if radii.ndim == 2 else (
            centre + radii[:, None] * rays)
        return field(places.reshape(-1, 3)).reshape(radii.shape)

    ladder = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, STEPS)
    heights = at(ladder)
    crossing = (heights[:, :-1] < 0.0) & (heights[:, 1:] >= 0.0)
    found = crossing.any(axis=1)
    if found.mean() < 0.95:
        return None
    last = (STEPS - 2 - np.argmax(crossing[:, ::-1], axis=1))[:, None]
    low, high = (np.take_along_axis(ladder, last + k, 1)[:, 0] for k in (0, 1))
    below, above = (np.take_along_axis(heights, last + k, 1)[:, 0] for k in (0, 1))
    for _ in range(REFINEMENTS):
        middle_radius = low - below * (high - low) / (above - below)
        value = at(middle_radius)
        inside = value < 0.0
        low, below = np.where(inside, middle_radius, low), np.where(inside, value, below)
        high, above = np.where(inside, high, middle_radius), np.where(inside, above, value)
    radii = np.where(np.abs(below) < np.abs(above), low, high)
    section = (radii * np.vstack([np.cos(angles), np.sin(angles)])).T[found]
    return ConvexHull(section).area  # of a polygon, SciPy's area is the perimeter


def main():
    points, normals, planes = read("points"), read("normals"), read("planes").reshape(-1, 3, 3)
    begin = time.process_time()
    spacing = np.median(cKDTree(points).query(points, 2)[0][:, 1])
    girths = [girth(points, normals, spacing, plane) for plane in planes]
    print(1e3 * (time.process_time() - begin) / len(planes))
    for length in girths:
        print("none" if length is None else repr(float(length)))


if __name__ == "__main__":
    main()
