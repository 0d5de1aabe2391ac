//! A trajectory as comma-separated values.

use std::io::{self, BufWriter, Write};

use super::Solution;
use crate::contract::System;
use crate::error::number;
use crate::method::Method;

impl<Sys: System<N>, Met: Method, const N: usize> Solution<Sys, Met, N> {
    /// Writes the points as comma-separated values: a header, and a row for each of
    /// [`Solution::points`].
    ///
    /// | column | what |
    /// |---|---|
    /// | `t` | time |
    /// | `region` | the name of the region that the point belongs to |
    /// | the name of a state, for each | its value |
    ///
    /// Numbers are as short as they can be so that they read back as the same doubles. At a
    /// transition there are two rows with the same time.
    ///
    /// # Errors
    /// What the writer cannot do.
    ///
    /// ```
    /// use dmm_runtime::{Best, Integrator, pws};
    ///
    /// pws! {
    ///     /// A ball that falls into a spring.
    ///     pub system Ball {
    ///         state x, v;
    ///         interface spring = x;
    ///         region free where spring > 0 { der(x) = v; der(v) = -1; }
    ///         region pressed where spring < 0 { der(x) = v; der(v) = -1 - 4*x; }
    ///     }
    /// }
    ///
    /// let solution = Integrator::new(&Ball {}, Best::tolerance(1e-12))
    ///     .initial(0.0, [0.5, 0.0])
    ///     .output_times([0.0, 0.25, 1.25])
    ///     .run_until(1.25)?;
    /// let mut csv = Vec::new();
    /// solution.write_csv(&mut csv)?;
    /// let csv = String::from_utf8(csv)?;
    /// assert!(csv.starts_with("t,region,x,v\n0,free,0.5,0\n0.25,free,0.46875,-0.25\n"), "{csv}");
    /// assert!(csv.contains("\n1.25,pressed,-0.2"), "{csv}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write_csv(&self, writer: impl Write) -> io::Result<()> {
        let mut writer = BufWriter::new(writer);
        let states = self.system().metadata().states;
        write!(writer, "t,region")?;
        for state in states {
            write!(writer, ",{}", quoted(state))?;
        }
        writeln!(writer)?;
        for point in self.points() {
            let region = self.system().of_region(point.region).name;
            write!(writer, "{},{}", number(point.t), quoted(region))?;
            // there may be room for more states than the system has
            for &x in point.x.iter().take(states.len()) {
                write!(writer, ",{}", number(x))?;
            }
            writeln!(writer)?;
        }
        writer.flush()
    }
}

/// A field, in quotation marks where it needs them (RFC 4180).
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_quoted_where_they_need_it() {
        assert_eq!(quoted("q[0]"), "q[0]");
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("5\""), "\"5\"\"\"");
    }

    #[test]
    fn numbers_read_back() {
        let numbers = [0.1, -1.0 / 3.0, 5e-324, 1.7e308, 1e16, 123_456.789, -0.0];
        for value in numbers {
            let read: f64 = number(value).parse().unwrap();
            assert_eq!(read.to_bits(), value.to_bits(), "{}", number(value));
            assert!(number(value).len() < 25, "{}", number(value));
        }
    }
}
