// Programs for the present settings, in five languages. Settings are a call and its options, named as in C:
//   { call, options: [[name, value], ...], ... }
// where a value is a number, a list of numbers, or a constant such as "bounded".

export const LANGUAGES = ["C", "C++", "Python", "Rust", "JavaScript"];

// The constants of options: in C, C++; in Rust.
const CONSTANTS = {
    bounded: ["AZULEJO_BOUNDARY_BOUNDED", "Boundary::Bounded"],
    periodic: ["AZULEJO_BOUNDARY_PERIODIC", "Boundary::Periodic"],
    progressive: ["AZULEJO_ORDER_PROGRESSIVE", "Order::Progressive"],
    first: ["AZULEJO_SURFACE_FIRST", "volume::Surface::First"],
};

// The parts of the programs of each call. `c`: what is declared, the calls behind the context, what is printed, what is freed.
const MESH = {
    c: ["azulejo_mesh *mesh = NULL;", "azulejo_mesh_load(FILE, &mesh)", "azulejo_mesh_free(mesh);"],
    cpp: "azulejo::Mesh mesh = azulejo::Mesh::load(FILE);",
    python: "mesh = azulejo.Mesh.load(FILE)",
    rust: "let mesh = Arc::new(Mesh::load(FILE)?);",
    javascript: "const mesh = Mesh.parse(FILE, readFileSync(FILE));",
};

const camel = (name) => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
const list = (values, open, close) => open + values.map(String).join(", ") + close;
// A number with a point, as Rust wants it for floats.
const float = (x) => (Number.isInteger(x) ? `${x}.0` : String(x));
const quoted = JSON.stringify;

function fieldsInC(options) {
    return options.flatMap(([name, value]) => {
        if (Array.isArray(value)) return value.map((x, axis) => `options.${name}[${axis}] = ${x};`);
        return [`options.${name} = ${CONSTANTS[value]?.[0] ?? value};`];
    });
}

const C_STRUCTS = {
    kdrt_window: "kdrt", kdrt_sample: "kdrt", psp_sample: "psp", psp_sample_classes: "psp", volume_sample: "volume",
    volume_sample_inside: "volume_inside", dcr_relax_density: "dcr", mask_create: "mask",
};

function c({ call, options, file, window, own, factor, count, size, levels }) {
    const lines = (...parts) => parts.flat().filter((line) => line !== null);
    const declared = [], calls = [], freed = [], before = [];
    let print = [
        "const float *positions = azulejo_points_positions(points);",
        `printf("%zu samples, the first at (%g, %g${call.startsWith("psp") || call.startsWith("volume") ? ", %g" : ""})\\n", azulejo_points_count(points),`,
        `       positions[0], positions[1]${call.startsWith("psp") || call.startsWith("volume") ? ", positions[2]" : ""});`,
    ];
    if (call !== "mask_create") {
        declared.push("azulejo_points *points = NULL;");
        freed.push("azulejo_points_free(points);");
    }
    if (file) {
        declared.push(MESH.c[0]);
        calls.push(MESH.c[1].replaceAll("FILE", quoted(file)));
        freed.push(MESH.c[2]);
    }
    if (call === "kdrt_window") {
        declared.push("azulejo_kdrt *plane = NULL;");
        before.push(`const double window_min[2] = ${list(window[0], "{", "}")}, window_max[2] = ${list(window[1], "{", "}")};`);
        calls.push("azulejo_kdrt_create(context, &options, &plane)", "azulejo_kdrt_window(plane, window_min, window_max, &points)");
        freed.push("azulejo_kdrt_free(plane);");
    } else if (call === "kdrt_sample") {
        calls.push("azulejo_kdrt_sample(context, &options, &points, NULL)");
    } else if (call === "psp_sample_classes") {
        before.push(`const double own[${own.length}] = ${list(own, "{", "}")};`, `double radii[${own.length ** 2}];`);
        before.push("azulejo_classes classes;", "azulejo_classes_init(&classes, sizeof classes);");
        before.push(`classes.count = ${own.length};`, "classes.radii = radii;");
        calls.push(`azulejo_classes_radii(own, ${own.length}, ${factor}, radii)`);
        calls.push("azulejo_psp_sample_classes(context, mesh, &options, &classes, &points, NULL)");
    } else if (call === "psp_sample" || call === "volume_sample_inside") {
        calls.push(`azulejo_${call}(context, mesh, &options, &points, NULL)`);
    } else if (call === "volume_sample") {
        calls.push("azulejo_volume_sample(context, &options, &points, NULL)");
    } else if (call === "dcr_relax_density") {
        declared.push("azulejo_points *start = NULL;");
        before.push(
            `/* The densities, row by row from below: put 1 - grey of your picture here. */`,
            `static float values[${size[0]} * ${size[1]}];`,
            `for (int i = 0; i < ${size[0]} * ${size[1]}; i++) values[i] = (float)(i % ${size[0]}) / ${size[0]};`,
            "azulejo_density density;", "azulejo_density_init(&density, sizeof density);",
            "density.values = values;", `density.width = ${size[0]};`, `density.height = ${size[1]};`,
        );
        calls.push(`azulejo_dcr_scatter(context, &options, &density, ${count}, &start)`);
        calls.push(`azulejo_dcr_relax_density(context, &options, &density, azulejo_points_positions(start), ${count}, &points, NULL)`);
        freed.push("azulejo_points_free(start);");
    } else if (call === "mask_create") {
        declared.push("azulejo_mask *mask = NULL;");
        before.push(
            "/* Light from 0 to 1, row by row: put your picture here. */",
            `static float image[${size[0]} * ${size[1]}];`, `static uint8_t dithered[${size[0]} * ${size[1]}];`,
            `for (int i = 0; i < ${size[0]} * ${size[1]}; i++) image[i] = (float)(i % ${size[0]}) / ${size[0]};`,
        );
        calls.push("azulejo_mask_create(context, &options, &mask, NULL)");
        calls.push(`azulejo_mask_dither(mask, image, ${size[0]}, ${size[1]}, 1, 1, ${levels}, dithered)`);
        print = ['printf("the first level is %d\\n", dithered[0]);'];
        freed.push("azulejo_mask_free(mask);");
    }
    const struct = `azulejo_${C_STRUCTS[call]}_options`;
    const body = lines(
        "azulejo_context *context = NULL;", declared, `${struct} options;`, `${struct}_init(&options, sizeof options);`,
        fieldsInC(options), before, "",
        "azulejo_status status = azulejo_context_create(0, &context);",
        calls.map((made) => `if (status == AZULEJO_OK) status = ${made};`),
        "if (status == AZULEJO_OK) {", print.map((line) => `    ${line}`), "} else {",
        "    char message[256];", "    azulejo_last_error_message(message, sizeof message);",
        '    fprintf(stderr, "%s\\n", message);', "}",
        freed, "azulejo_context_free(context);", "return status != AZULEJO_OK;",
    );
    return ["#include <azulejo.h>", "#include <stdint.h>", "#include <stdio.h>", "", "int main(void) {",
        ...body.map((line) => (line ? `    ${line}` : line)), "}", ""].join("\n");
}

function cpp({ call, options, file, window, own, factor, count, size, levels }) {
    const kinds = {
        kdrt: "Kdrt", psp: "Psp", volume: "Volume", volume_inside: "VolumeInside", dcr: "Dcr", mask: "Mask",
    };
    const body = ["azulejo::Context context;"];
    if (file) body.push(MESH.cpp.replaceAll("FILE", quoted(file)));
    body.push(`azulejo::${kinds[C_STRUCTS[call]]}Options options;`, ...fieldsInC(options));
    const gradient = (name) => [
        `std::vector<float> ${name}(${size[0]} * ${size[1]});`,
        `for (std::size_t i = 0; i < ${name}.size(); i++) ${name}[i] = float(i % ${size[0]}) / ${size[0]};`,
    ];
    if (call === "kdrt_window") {
        body.push("azulejo::Kdrt plane(context, options);");
        body.push(`azulejo::Points points = plane.window(${list(window[0], "{", "}")}, ${list(window[1], "{", "}")});`);
    } else if (call === "psp_sample_classes") {
        body.push(`const std::vector<double> own = ${list(own, "{", "}")};`);
        body.push(`azulejo::Points points = azulejo::psp_sample_classes(context, mesh, options, azulejo::classes_radii(own, ${factor}));`);
    } else if (call === "dcr_relax_density") {
        body.push("// The densities, row by row from below: put 1 - grey of your picture here.", ...gradient("values"));
        body.push("azulejo::Density density;", "density.values = values;", `density.width = ${size[0]};`);
        body.push(`azulejo::Points start = azulejo::dcr_scatter(context, options, density, ${count});`);
        body.push("azulejo::Points points = azulejo::dcr_relax_density(context, options, density, start);");
    } else if (call === "mask_create") {
        body.push("azulejo::Mask mask = azulejo::mask_create(context, options);");
        body.push("// Light from 0 to 1, row by row: put your picture here.", ...gradient("image"));
        body.push("std::vector<std::uint8_t> dithered(image.size());");
        body.push(`azulejo::check(mask.try_dither(image, ${size[0]}, 1, ${levels}, dithered));`);
        body.push('std::printf("the first level is %d\\n", dithered[0]);');
    } else {
        body.push(`azulejo::Points points = azulejo::${call}(context, ${file ? "mesh, " : ""}options);`);
    }
    if (call !== "mask_create") body.push('std::printf("%zu samples\\n", points.size());');
    return ["#include <azulejo.hpp>", "#include <cstdio>", "#include <vector>", "", "int main() {",
        ...body.map((line) => `    ${line}`), "}", ""].join("\n");
}

function python({ call, options, file, window, own, factor, count, size, levels }) {
    const value = (x) => (Array.isArray(x) ? list(x, "[", "]") : CONSTANTS[x] ? quoted(x) : x);
    const given = (names = () => true) => options.filter(([name]) => names(name)).map(([name, x]) => `${name}=${value(x)}`);
    const args = (...parts) => parts.flat().join(", ");
    const out = ["import azulejo"];
    if (size) out.push("import numpy as np");
    out.push("");
    if (file) out.push(MESH.python.replaceAll("FILE", quoted(file)));
    if (call === "kdrt_window") {
        out.push(`plane = azulejo.KdrtPlane(${args(given())})`);
        out.push(`points = plane.window(${list(window[0], "[", "]")}, ${list(window[1], "[", "]")})`);
    } else if (call === "psp_sample_classes") {
        out.push(`radii = azulejo.classes_radii(${list(own, "[", "]")}, ${factor})`);
        out.push(`points = azulejo.psp_sample_classes(mesh, radii, ${args(given())})`);
    } else if (call === "dcr_relax_density") {
        const ofBoth = (name) => name !== "max_iterations";
        out.push("# The densities, row by row from below: put 1 - grey of your picture here.");
        out.push(`density = np.tile(np.arange(${size[0]}, dtype=np.float32) / ${size[0]}, (${size[1]}, 1))`);
        out.push(`start = azulejo.dcr_scatter(${args("density", String(count), given(ofBoth))})`);
        out.push(`points = azulejo.dcr_relax_density(${args("start", "density", given((name) => !["domain_max", "boundary"].includes(name)))})`);
    } else if (call === "mask_create") {
        out.push(`ranks = azulejo.mask_create(${args(given())})`);
        out.push("# Light from 0 to 1, row by row: put your picture here.");
        out.push(`image = np.tile(np.arange(${size[0]}) / ${size[0]}, (${size[1]}, 1))`);
        out.push(`dithered = azulejo.mask_dither(ranks, image, ${levels})`);
        out.push('print("the first level is", dithered[0, 0])');
        return [...out, ""].join("\n");
    } else {
        out.push(`points = azulejo.${call}(${args(file ? ["mesh"] : [], given())})`);
    }
    out.push('print(len(points), "samples, the first at", points.positions[0])');
    return [...out, ""].join("\n");
}

function javascript({ call, options, file, window, own, factor, count, size, levels }) {
    const value = (x) => (Array.isArray(x) ? list(x, "[", "]") : CONSTANTS[x] ? quoted(x) : x);
    const object = (chosen) => `{ ${chosen.map(([name, x]) => `${camel(name)}: ${value(x)}`).join(", ")} }`;
    const given = object(options);
    const body = [];
    const names = new Set(["init"]);
    if (file) {
        names.add("Mesh");
        body.push(MESH.javascript.replaceAll("FILE", quoted(file)));
    }
    const gradient = (name) => `const ${name} = Float32Array.from({ length: ${size[0] * size[1]} }, (_, i) => (i % ${size[0]}) / ${size[0]});`;
    if (call === "kdrt_window") {
        names.add("KdrtPlane");
        body.push(`const plane = new KdrtPlane(${given});`);
        body.push(`const { positions } = plane.window(${list(window[0], "[", "]")}, ${list(window[1], "[", "]")});`);
    } else if (call === "psp_sample_classes") {
        names.add("classesRadii").add("pspSampleClasses");
        body.push(`const { positions } = pspSampleClasses(mesh, ${given}, classesRadii(${list(own, "[", "]")}, ${factor}));`);
    } else if (call === "dcr_relax_density") {
        names.add("dcrScatter").add("dcrRelaxDensity");
        body.push("// The densities, row by row from below: put 1 - grey of your picture here.", gradient("values"));
        body.push(`const density = { values, width: ${size[0]}, height: ${size[1]} };`);
        body.push(`const start = dcrScatter(density, ${count}, ${object(options.filter(([name]) => name !== "max_iterations"))});`);
        body.push(`const { positions } = dcrRelaxDensity(start.positions, density, ${given});`);
    } else if (call === "mask_create") {
        names.add("maskCreate").add("maskDither");
        body.push(`const options = ${given};`, "const ranks = maskCreate(options);");
        body.push("// Light from 0 to 1, row by row: put your picture here.", gradient("values"));
        body.push(`const dithered = maskDither(ranks, options, { values, width: ${size[0]}, height: ${size[1]} }, ${levels});`);
        body.push('console.log("the first level is", dithered[0]);');
    } else {
        names.add(camel(call));
        body.push(`const { positions } = ${camel(call)}(${file ? "mesh, " : ""}${given});`);
    }
    if (call !== "mask_create") {
        const axes = call.startsWith("psp") || call.startsWith("volume") ? 3 : 2;
        body.push(`console.log(positions.length / ${axes}, "samples");`);
    }
    const head = file ? ['import { readFileSync } from "node:fs";'] : [];
    return [...head, `import { ${[...names].join(", ")} } from "azulejo";`, "", "await init();", ...body, ""].join("\n");
}

function rust({ call, options, file, window, own, factor, count, size, levels }) {
    const all = Object.fromEntries(options);
    const uses = new Set(["Context"]);
    const body = ["let context = Context::new(0)?; // all cores"];
    if (file) body.push(MESH.rust.replaceAll("FILE", quoted(file)));
    // The domain, and the options that are set by methods of their names.
    const axes = (values) => list(values.map(float), "[", "]");
    const domain = () => {
        if (!all.domain_max && !all.boundary) return "";
        uses.add("Boundary").add("Domain");
        const [min, max] = [all.domain_min ?? all.domain_max.map(() => 0), all.domain_max];
        return `.domain(Domain { min: ${axes(min)}, max: ${axes(max)}, boundary: ${CONSTANTS[all.boundary ?? "periodic"][1]} })`;
    };
    const set = (...names) => names.filter((name) => name in all).map((name) => {
        if (all[name] === "progressive") uses.add("Order");
        return `.${name}(${CONSTANTS[all[name]]?.[1] ?? (name === "sigma" || name === "tolerance" ? float(all[name]) : all[name])})`;
    }).join("");
    const amount = all.count ? `by_count(${all.count})` : `new(${float(all.radius ?? 0)})`;
    const gradient = (name) => `let ${name}: Vec<f32> = (0..${size[0]} * ${size[1]}).map(|i| (i % ${size[0]}) as f32 / ${size[0]}.0).collect();`;
    const print = 'println!("{} samples, the first at {:?}", points.len(), points.positions[0]);';
    let module = "kdrt";
    if (call === "kdrt_window") {
        body.push(`let options = kdrt::Options::new(${float(all.radius)})${domain()}${set("seed")};`);
        body.push("let plane = kdrt::Plane::new(&context, &options, None)?;");
        body.push(`let points = plane.window(${axes(window[0])}, ${axes(window[1])})?;`, print);
    } else if (call === "kdrt_sample") {
        body.push(`let options = kdrt::Options::new(${float(all.radius)})${domain()}${set("seed")};`);
        body.push("let points = kdrt::sample(&context, &options, None)?;", print);
    } else if (call === "psp_sample") {
        module = "psp";
        body.push(`let options = psp::Options::${amount}${set("order", "seed")};`);
        body.push("let (points, _) = psp::sample(&context, &mesh, &options, None)?;", print);
    } else if (call === "psp_sample_classes") {
        module = "psp";
        uses.add("Classes");
        body.push(`let classes = Classes::of_radii(&${axes(own)}, ${float(factor)})?;`);
        body.push(`let options = psp::ClassOptions::default()${set("order", "seed")};`);
        body.push("let (points, _) = psp::sample_classes(&context, &mesh, &options, &classes, None, None)?;", print);
    } else if (call === "volume_sample") {
        module = "volume";
        body.push(`let options = volume::Options::${amount}${domain()}${set("order", "seed")};`);
        body.push("let (points, _) = volume::sample(&context, &options, None)?;", print);
    } else if (call === "volume_sample_inside") {
        module = "volume";
        body.push(`let options = volume::InsideOptions::${amount}${set("surface", "order", "seed")};`);
        body.push("let (points, _) = volume::sample_inside(&context, &mesh, &options, None)?;", print);
    } else if (call === "dcr_relax_density") {
        module = "dcr";
        uses.add("Boundary").add("Domain");
        body.push("// The densities, row by row from below: put 1 - grey of your picture here.", gradient("values"));
        body.push(`let density = dcr::Density::Image { values: &values, width: ${size[0]}, height: ${size[1]} };`);
        body.push(`let domain = Domain { min: [0.0, 0.0], max: ${axes(all.domain_max)}, boundary: Boundary::Bounded };`);
        body.push(`let start = dcr::scatter(&context, &domain, &density, ${count}, ${all.seed}, None)?;`);
        body.push(`let options = dcr::DelaunayOptions::new(domain)${set("max_iterations", "seed")};`);
        body.push("let (points, _) = dcr::relax_with_density(&context, &options, &density, &start, None)?;");
        body.push('println!("{} samples, the first at {:?}", points.len(), points[0]);');
    } else if (call === "mask_create") {
        module = "mask";
        body.push(`let options = mask::Options::new(${all.width}, ${all.height})${set("seed", "sigma")};`);
        body.push("let (mask, _) = mask::create(&context, &options, None)?;");
        body.push("// Light from 0 to 1, row by row: put your picture here.", gradient("values"));
        body.push(`let image = mask::Image { size: [${size[0]}, ${size[1]}, 1], channels: 1, pixels: mask::Pixels::Floats(&values) };`);
        body.push(`let dithered = mask.dither(&image, ${levels})?;`, 'println!("the first level is {}", dithered[0]);');
    }
    const imports = [...uses].sort().concat(module).join(", ");
    return [...(file ? ["use std::sync::Arc;", "", "use azulejo::mesh::Mesh;"] : []), `use azulejo::{${imports}};`, "", "fn main() -> azulejo::Result<()> {",
        ...body.map((line) => `    ${line}`), "    Ok(())", "}", ""].join("\n");
}

const WRITERS = { C: c, "C++": cpp, Python: python, Rust: rust, JavaScript: javascript };

// The program of settings.
export const write = (language, settings) => WRITERS[language](settings);
