//! A trajectory as comma-separated values.

use std::io::{self, BufWriter, Write};

use super::Solution;
use super::discrete::discrete;
use crate::contract::{Metadata, System, Vector};
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
    /// | the name of a discrete state, for each | its value |
    ///
    /// Numbers are as short as they can be so that they read back as the same doubles. At a
    /// transition there are two rows with the same time: before and behind it.
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
        let system = self.system();
        write!(writer, "t,region")?;
        names(&mut writer, system.metadata(), "")?;
        writeln!(writer)?;
        for point in self.points() {
            let region = system.of_region(point.region).name;
            write!(writer, "{},{}", number(point.t), quoted(region))?;
            values(&mut writer, system, &point.x, point.region)?;
            writeln!(writer)?;
        }
        writer.flush()
    }

    /// Writes the transitions as comma-separated values: a header, and a row for each of
    /// [`Solution::transitions`].
    ///
    /// | column | what |
    /// |---|---|
    /// | `t` | t̂* |
    /// | `interface` | the name of the interface |
    /// | `from`, `to` | the names of the regions before and behind it |
    /// | `kind` | [`TransitionKind::name`](crate::TransitionKind::name) |
    /// | the name of a state or discrete state, for each | its value before |
    /// | the same with `_after`, if there are events | its value behind |
    /// | `rate_from`, `rate_to` | dg/dt before and behind |
    ///
    /// # Errors
    /// What the writer cannot do.
    ///
    /// ```
    /// use dmm_runtime::{Best, Integrator, pws};
    ///
    /// pws! {
    ///     /// A ball that bounces, and counts.
    ///     pub system Ball {
    ///         state y, v;
    ///         discrete bounces = 0;
    ///         interface floor = y;
    ///         der(y) = v;
    ///         der(v) = -1;
    ///         on floor falling {
    ///             v = -v / 2;
    ///             bounces = bounces + 1;
    ///         }
    ///     }
    /// }
    ///
    /// let solution = Integrator::new(&Ball {}, Best::tolerance(1e-12))
    ///     .initial(0.0, [0.5, 0.0])
    ///     .output_times([1.0, 1.5])
    ///     .run_until(1.5)?;
    /// let (mut points, mut transitions) = (Vec::new(), Vec::new());
    /// solution.write_csv(&mut points)?;
    /// solution.write_transitions_csv(&mut transitions)?;
    /// let header = "t,interface,from,to,kind,y,v,bounces,y_after,v_after,bounces_after,";
    /// let row = "1,floor,everywhere,everywhere,jumped,0,-1,0,0,0.5,1,";
    /// assert_eq!(
    ///     String::from_utf8(transitions)?,
    ///     format!("{header}rate_from,rate_to\n{row}-1,0.5\n")
    /// );
    /// assert!(String::from_utf8(points)?.ends_with("\n1.5,everywhere,0.125,0,1\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write_transitions_csv(&self, writer: impl Write) -> io::Result<()> {
        let mut writer = BufWriter::new(writer);
        let (system, metadata) = (self.system(), self.system().metadata());
        let has_events = !metadata.events.is_empty();
        write!(writer, "t,interface,from,to,kind")?;
        names(&mut writer, metadata, "")?;
        if has_events {
            names(&mut writer, metadata, "_after")?;
        }
        writeln!(writer, ",rate_from,rate_to")?;
        for transition in self.transitions() {
            write!(writer, "{}", number(transition.t))?;
            let [from, to] = [transition.from, transition.to];
            for name in [
                metadata.guard_name(transition.interface),
                system.of_region(from).name,
                system.of_region(to).name,
                transition.kind.name(),
            ] {
                write!(writer, ",{}", quoted(name))?;
            }
            values(&mut writer, system, &transition.x, from)?;
            if has_events {
                values(&mut writer, system, &transition.after, to)?;
            }
            let rates = [transition.rate_from, transition.rate_to].map(number);
            writeln!(writer, ",{},{}", rates[0], rates[1])?;
        }
        writer.flush()
    }
}

/// The names of the states and of the discrete states, each with an ending.
fn names(writer: &mut impl Write, metadata: &Metadata, ending: &str) -> io::Result<()> {
    let states = metadata.states.iter().copied();
    let discrete = metadata.declared_discrete().map(|(_, name)| name);
    for name in states.chain(discrete) {
        write!(writer, ",{}", quoted(&format!("{name}{ending}")))?;
    }
    Ok(())
}

/// The values of the states and of the discrete states.
fn values<Sys: System<N>, const N: usize>(
    writer: &mut impl Write,
    system: &Sys,
    x: &Vector<f64, N>,
    mode: Sys::Region,
) -> io::Result<()> {
    // there may be room for more states than the system has
    let states = x.iter().copied().take(system.metadata().states.len());
    for value in states.chain(discrete(system, mode)) {
        write!(writer, ",{}", number(value))?;
    }
    Ok(())
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
