# SPDX-License-Identifier: MIT
"""What scripts that measure zvo with files of their own share: pictures, glTF files, and a run of the program."""
import base64
import dataclasses
import json
import os
import pathlib
import struct
import subprocess
import zlib

ZVO = pathlib.Path(__file__).resolve().parent.parent / 'build/release/bin/zvo'


def png(edge, rows):
    """A PNG file of edge x edge pixels in RGB. rows: the bytes of each row."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))

    deflate = zlib.compressobj(1)
    data = [deflate.compress(b'\0' + row) for row in rows] + [deflate.flush()]
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', edge, edge, 8, 2, 0, 0, 0)) +
            chunk(b'IDAT', b''.join(data)) + chunk(b'IEND', b''))


def data_uri(kind, data):
    return f'data:{kind};base64,' + base64.b64encode(data).decode()


def write_gltf(folder, positions, uvs, nodes, roots, picture_uris=()):
    """Writes a glTF file and returns its path. Its meshes are triangle strips of the same vertices: one without a
    picture, or one for each of picture_uris."""
    count = len(positions)
    arrays = [struct.pack(f'<{3 * count}f', *sum(positions, ())), struct.pack(f'<{2 * count}f', *sum(uvs, ()))]
    meshes = [{'primitives': [{'attributes': {'POSITION': 0, 'TEXCOORD_0': 1}, 'mode': 5}]}
              for _ in picture_uris or [None]]
    document = {
        'asset': {'version': '2.0'}, 'scene': 0, 'scenes': [{'nodes': roots}], 'nodes': nodes, 'meshes': meshes,
        'buffers': [{'uri': data_uri('application/octet-stream', b''.join(arrays)),
                     'byteLength': sum(map(len, arrays))}],
        'bufferViews': [{'buffer': 0, 'byteLength': len(arrays[0])},
                        {'buffer': 0, 'byteOffset': len(arrays[0]), 'byteLength': len(arrays[1])}],
        'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': count, 'type': 'VEC3',
                       'min': [min(axis) for axis in zip(*positions)], 'max': [max(axis) for axis in zip(*positions)]},
                      {'bufferView': 1, 'componentType': 5126, 'count': count, 'type': 'VEC2'}]}
    if picture_uris:
        document['images'] = [{'uri': uri} for uri in picture_uris]
        document['textures'] = [{'source': i} for i in range(len(picture_uris))]
        document['materials'] = [{'pbrMetallicRoughness': {'baseColorTexture': {'index': i}}}
                                 for i in range(len(picture_uris))]
        for i, mesh in enumerate(meshes):
            mesh['primitives'][0]['material'] = i
    path = folder / 'scene.gltf'
    path.write_text(json.dumps(document))
    return path


@dataclasses.dataclass
class Run:
    exit_code: int
    said: str              # on stderr
    user_seconds: float    # of all threads
    system_seconds: float
    peak_bytes: int        # of memory


def voxelize(zvo, scene, resolution):
    """Runs zvo voxelize on a scene, into a file beside it."""
    command = [zvo, 'voxelize', scene, '-o', scene.parent / 'voxels.morton', '-f', '--resolution', str(resolution)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE)
    said = process.stderr.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)  # so that the destructor does not wait
    return Run(process.returncode, said, usage.ru_utime, usage.ru_stime, usage.ru_maxrss * 1024)
