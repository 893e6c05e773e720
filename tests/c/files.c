/* Mesh files: good ones, and every way in which one can be bad. The message names the file. */

#include <sys/stat.h>
#include <unistd.h>

#include "samples.h"

static char directory[] = "/tmp/azulejo-files-XXXXXX";

static const char *path_of(const char *name) {
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return path;
}

static const char *write_file(const char *name, const void *bytes, size_t size) {
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    if (!CHECK(file != NULL)) exit(finish());
    CHECK(fwrite(bytes, 1, size, file) == size);
    CHECK(fclose(file) == 0);
    return path;
}

static void loads(const char *name, const char *text, size_t vertices, size_t triangles) {
    const char *path = write_file(name, text, strlen(text));
    azulejo_mesh *mesh = NULL;
    if (ACCEPTED(azulejo_mesh_load(path, &mesh))) {
        CHECK(azulejo_mesh_vertex_count(mesh) == vertices);
        CHECK(azulejo_mesh_triangle_count(mesh) == triangles);
    }
    azulejo_mesh_free(mesh);
    unlink(path);
}

static void fails(const char *name, const void *bytes, size_t size) {
    const char *path = write_file(name, bytes, size);
    azulejo_mesh *mesh = UNTOUCHED;
    REFUSED(AZULEJO_ERROR_FORMAT, name, azulejo_mesh_load(path, &mesh));
    CHECK(mesh == UNTOUCHED);
    unlink(path);
}

static void fails_text(const char *name, const char *text) { fails(name, text, strlen(text)); }

#define PLY "ply\nformat ascii 1.0\n"
#define BINARY "ply\nformat binary_little_endian 1.0\n"
#define VERTICES "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define FACES "element face 1\nproperty list uchar int vertex_indices\nend_header\n"

#define FACET "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"

static void good_files(void) {
    loads("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 3, 1);
    loads("quad.OBJ", "# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n", 4, 2);
    loads("relative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1", 3, 1);
    loads("unused.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n", 4, 1);
    loads("triangle.ply", PLY VERTICES FACES "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 3, 1);
    loads("no_extension", PLY VERTICES FACES "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 3, 1);
    loads("triangle.stl", "solid\n" FACET "endsolid\nsolid\n" FACET "endsolid\n", 6, 2);
}

static void bad_obj_files(void) {
    fails_text("empty.obj", "");
    fails_text("blank.obj", "\n\n# nothing\n");
    fails_text("no_faces.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    fails_text("no_vertices.obj", "f 1 2 3\n");
    fails_text("truncated_vertex.obj", "v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n");
    fails_text("words.obj", "v zero one two\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fails_text("zero_index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n");
    fails_text("index_beyond.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    fails_text("index_absurd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n");
    fails_text("index_before.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n");
    fails_text("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
    fails_text("overflow.obj", "v 0 0 0\nv 1e99 0 0\nv 0 1 0\nf 1 2 3\n");
    fails_text("no_area.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    fails("junk.obj", "\0\377\376\200f\0\1v", 8);
}

static void bad_ply_files(void) {
    fails_text("empty.ply", "");
    fails_text("not.ply", "solid cube\n");
    fails_text("magic.ply", "ply\n");
    fails_text("no_end.ply", PLY VERTICES);
    fails_text("no_format.ply", "ply\n" VERTICES FACES "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    fails_text("future.ply", "ply\nformat quantum 7.0\n" VERTICES FACES);
    fails_text("no_vertices.ply", PLY FACES "3 0 1 2\n");
    fails_text("truncated.ply", PLY VERTICES FACES "0 0 0\n1 0 0\n");
    fails_text("truncated_line.ply", PLY VERTICES FACES "0 0 0\n1 0 0\n0 1 0\n3 0 1");
    fails_text("words.ply", PLY VERTICES FACES "0 0 0\none 0 0\n0 1 0\n3 0 1 2\n");
    fails_text("index_beyond.ply", PLY VERTICES FACES "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n");
    fails_text("index_negative.ply", PLY VERTICES FACES "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n");
    fails_text("nan.ply", PLY VERTICES FACES "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n");
    fails_text("huge_count.ply", BINARY "element vertex 4000000000\nproperty float x\nproperty float y\n"
                                        "property float z\nend_header\nabc");
    fails_text("huge_count_text.ply", PLY "element vertex 18446744073709551615\nproperty float x\nproperty float y\n"
                                          "property float z\nend_header\n0 0 0\n");
    fails_text("huge_list.ply", BINARY "element face 1\nproperty list uint int vertex_indices\nend_header\n"
                                       "\377\377\377\377\1");
    fails_text("overflow_count.ply", PLY "element vertex 99999999999999999999999\nproperty float x\nend_header\n");
    fails("truncated_binary.ply", BINARY VERTICES FACES "\0\0\0\0\0", sizeof(BINARY VERTICES FACES) - 1 + 5);
}

static void bad_stl_files(void) {
    char binary[84 + 50] = {0};
    fails_text("empty.stl", "");
    fails_text("not.stl", "v 0 0 0\n");
    fails_text("no_facets.stl", "solid\nendsolid\n");
    fails_text("words.stl", "solid\nfacet\nvertex zero one two\n");
    fails_text("truncated.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\n");
    binary[80] = 2;
    fails("truncated_binary.stl", binary, sizeof binary);
    memset(binary + 80, 0xff, 4);
    fails("huge_count.stl", binary, sizeof binary);
}

static void not_files(void) {
    azulejo_mesh *mesh = UNTOUCHED;
    REFUSED(AZULEJO_ERROR_IO, "missing.obj", azulejo_mesh_load(path_of("missing.obj"), &mesh));
    REFUSED(AZULEJO_ERROR_IO, directory, azulejo_mesh_load(directory, &mesh));
    REFUSED(AZULEJO_ERROR_IO, "zero", azulejo_mesh_load("/dev/zero", &mesh));
    REFUSED(AZULEJO_ERROR_IO, "", azulejo_mesh_load("", &mesh));
    CHECK(mkdir(path_of("directory.ply"), 0700) == 0);
    REFUSED(AZULEJO_ERROR_IO, "directory.ply", azulejo_mesh_load(path_of("directory.ply"), &mesh));
    rmdir(path_of("directory.ply"));
    CHECK(mkfifo(path_of("pipe.obj"), 0600) == 0);
    REFUSED(AZULEJO_ERROR_IO, "pipe.obj", azulejo_mesh_load(path_of("pipe.obj"), &mesh));
    unlink(path_of("pipe.obj"));
    CHECK(mesh == UNTOUCHED);
}

int main(void) {
    if (!CHECK(mkdtemp(directory) != NULL)) return finish();
    good_files();
    bad_obj_files();
    bad_ply_files();
    bad_stl_files();
    not_files();
    CHECK(rmdir(directory) == 0);
    return finish();
}
