//! Reports: what a call says of its result, as classes whose fields have names.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

/// Defines the class of a report: its fields, its text in Python, and what pickle and copy make it of.
macro_rules! report {
    ($(#[$about:meta])* $name:ident { $($(#[$meaning:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$about])*
        #[pyclass(frozen, get_all, module = "azulejo")]
        pub(crate) struct $name {
            $($(#[$meaning])* pub(crate) $field: $type,)*
        }

        #[pymethods]
        impl $name {
            #[new]
            #[pyo3(signature = (*, $($field),*))]
            fn new($($field: $type),*) -> Self {
                Self { $($field),* }
            }

            fn __repr__(report: &Bound<'_, Self>) -> PyResult<String> {
                $crate::report::shown(report.as_any(), &[$(stringify!($field)),*])
            }

            fn __reduce__<'py>(report: &Bound<'py, Self>) -> PyResult<$crate::report::Reduced<'py>> {
                $crate::report::reduced(report.as_any(), &[$(stringify!($field)),*])
            }
        }
    };
}
pub(crate) use report;

/// The parts of which an object is made again: a callable and its arguments, a class with those of its constructor.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, (Bound<'py, PyType>, (), Bound<'py, PyDict>));

/// The fields of a report by name, in an expression that makes it.
pub(crate) fn shown(report: &Bound<'_, PyAny>, fields: &[&str]) -> PyResult<String> {
    let field = |name: &&str| Ok(format!("{name}={}", report.getattr(*name)?.repr()?));
    let fields: Vec<_> = fields.iter().map(field).collect::<PyResult<_>>()?;
    Ok(format!("azulejo.{}({})", report.get_type().name()?, fields.join(", ")))
}

/// The constructor of a report, with its fields as keywords.
pub(crate) fn reduced<'py>(report: &Bound<'py, PyAny>, fields: &[&str]) -> PyResult<Reduced<'py>> {
    let py = report.py();
    let keywords = PyDict::new(py);
    fields.iter().try_for_each(|&name| keywords.set_item(name, report.getattr(name)?))?;
    Ok((py.import("copyreg")?.getattr("__newobj_ex__")?, (report.get_type(), (), keywords)))
}
