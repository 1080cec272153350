"""A surface of triangles as a file for CAD and viewers: STL and PLY in millimetres, GLB in metres as its standard says."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np

from palmar.errors import InputError
from palmar.faces.exports.whole_file import write_whole
from palmar.geometry.prism import Mesh

SOLIDS = (".stl", ".ply", ".glb")
FLOAT, UNSIGNED = 5126, 5125
POINTS, INDICES = 34962, 34963


def write_solid(path: Path, mesh: Mesh) -> None:
    """Write the surface whole or not at all; raises InputError for an unknown ending, OutputError where writing fails."""
    texts: dict[str, Callable[[Mesh], bytes]] = {".stl": _stl, ".ply": _ply, ".glb": _glb}
    ending = path.suffix.lower()
    if ending not in texts:
        raise InputError("--out", str(path), f"a swept region is written as {', '.join(SOLIDS)}")
    data = texts[ending](mesh)
    write_whole(path, lambda partial: _write(partial, data))


def _write(path: Path, data: bytes) -> None:
    path.write_bytes(data)


def _stl(mesh: Mesh) -> bytes:
    """Binary STL: normal and three corners of each triangle, little-endian."""
    corners = (1e3 * mesh.corners)[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    rows = np.zeros(len(corners), dtype=[("floats", "<f4", 12), ("attribute", "<u2")])
    rows["floats"] = np.concatenate([normals / np.where(length > 0.0, length, 1.0), corners.reshape(-1, 9)], axis=1)
    return b"palmar: swept region, mm".ljust(80) + struct.pack("<I", len(rows)) + rows.tobytes()


def _ply(mesh: Mesh) -> bytes:
    """Binary PLY, little-endian."""
    header = (
        "ply\nformat binary_little_endian 1.0\ncomment palmar: swept region, mm\n"
        f"element vertex {len(mesh.corners)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = np.zeros(len(mesh.triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, mesh.triangles
    return header.encode("ascii") + (1e3 * mesh.corners).astype("<f4").tobytes() + faces.tobytes()


def _glb(mesh: Mesh) -> bytes:
    """Binary glTF 2.0: one mesh; glTF's y is up, so the axis of the sweep becomes its y axis."""
    x, y, z = mesh.corners.T.astype("<f4")
    corners = np.stack([x, z, -y], axis=1)
    indices = mesh.triangles.astype("<u4").tobytes()
    binary = corners.tobytes() + indices
    views = [
        {"buffer": 0, "byteOffset": 0, "byteLength": corners.nbytes, "target": POINTS},
        {"buffer": 0, "byteOffset": corners.nbytes, "byteLength": len(indices), "target": INDICES},
    ]
    low, high = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
    point = {"bufferView": 0, "componentType": FLOAT, "count": len(corners), "type": "VEC3", "min": low, "max": high}
    index = {"bufferView": 1, "componentType": UNSIGNED, "count": mesh.triangles.size, "type": "SCALAR"}
    described = {
        "asset": {"version": "2.0", "generator": "palmar"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "swept region, m"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [point, index],
        "bufferViews": views,
        "buffers": [{"byteLength": len(binary)}],
    }
    text = json.dumps(described, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks
