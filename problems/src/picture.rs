//! Pictures: panels of curves with linear or logarithmic axes, written as SVG or PNG.
//!
//! Drawn by `kuva`, whose bitmap back end brings its own font, so that pictures look the same
//! everywhere. A logarithmic axis is drawn as the linear axis of the logarithm, with powers
//! as labels.

use std::io;
use std::path::Path;
use std::sync::Arc;

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::prelude::{Figure, Layout, LegendPosition, LinePlot, Plot, ScatterPlot, TickFormat};

/// Colours that differ in lightness too (Okabe & Ito).
pub const COLOURS: [&str; 7] = [
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#222222",
];
/// For lines of comparison.
pub const GREY: &str = "#888888";

/// Pixels of a PNG for each unit of the layout.
const PNG_SCALE: f32 = 2.0;

/// How a picture is stored.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// Scalable vector graphics.
    Svg,
    /// Portable network graphics.
    Png,
}

impl Format {
    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }
}

/// How an axis maps its values.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Scale {
    /// As they are.
    Linear,
    /// By their logarithm to base 10.
    Decades,
    /// By their logarithm to base 2.
    Octaves,
}

impl Scale {
    fn map(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Decades => value.log10(),
            Self::Octaves => value.log2(),
        }
    }

    fn tick_format(self) -> TickFormat {
        let base = match self {
            Self::Linear => return TickFormat::Auto,
            Self::Decades => "10",
            Self::Octaves => "2",
        };
        TickFormat::Custom(Arc::new(move |exponent: f64| {
            format!("{base}{}", superscript(exponent.round() as i64))
        }))
    }
}

/// An integer as raised digits.
pub fn superscript(exponent: i64) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let sign = if exponent < 0 { "⁻" } else { "" };
    let digits = exponent.unsigned_abs().to_string();
    let raised = digits
        .bytes()
        .map(|digit| DIGITS[usize::from(digit - b'0')]);
    sign.chars().chain(raised).collect()
}

/// An axis.
#[derive(Clone, PartialEq, Debug)]
pub struct Axis {
    /// What it shows.
    pub label: String,
    /// How.
    pub scale: Scale,
}

impl Axis {
    /// An axis.
    pub fn new(label: impl Into<String>, scale: Scale) -> Self {
        Self {
            label: label.into(),
            scale,
        }
    }
}

/// How a curve is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stroke {
    /// A line.
    Solid,
    /// A broken line.
    Dashed,
    /// A thin line.
    Thin,
    /// Points only.
    Dots,
    /// Points so small that many make a line.
    Fine,
    /// Points joined by a line.
    Marked,
}

/// A curve.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// Its entry in the legend, if it has one.
    pub label: Option<String>,
    /// Where it goes.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub stroke: Stroke,
    /// In which colour.
    pub colour: &'static str,
}

/// Where the legend stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Legend {
    /// There is none.
    None,
    /// Below the panel.
    Below,
}

/// A panel.
#[derive(Clone, PartialEq, Debug)]
pub struct Panel {
    /// Its title.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Its curves.
    pub curves: Vec<Curve>,
    /// Its legend.
    pub legend: Legend,
    /// Whether a unit is as long on both axes.
    pub equal_aspect: bool,
}

impl Panel {
    /// An empty panel.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            curves: Vec::new(),
            legend: Legend::Below,
            equal_aspect: false,
        }
    }

    /// Adds a curve.
    pub fn curve(
        &mut self,
        label: Option<String>,
        points: Vec<(f64, f64)>,
        stroke: Stroke,
        colour: &'static str,
    ) {
        self.curves.push(Curve {
            label,
            points,
            stroke,
            colour,
        });
    }

    /// Adds a line of slope `order` below the curves, all but the first `skip`, of a panel of
    /// errors against step sizes.
    pub fn slope(&mut self, order: i32, skip: usize) {
        let curves = || {
            self.curves
                .iter()
                .skip(skip)
                .flat_map(|curve| &curve.points)
        };
        let points = || curves().filter(|point| point.1 > 0.0);
        let first = points().map(|point| point.0).fold(f64::INFINITY, f64::min);
        let last = points().map(|point| point.0).fold(0.0, f64::max);
        let factors = points().map(|point| point.1 / point.0.powi(order));
        let lowest = factors.fold(f64::INFINITY, f64::min);
        if !(first < last && lowest.is_finite()) {
            return;
        }
        let line = |x: f64| (x, 0.4 * lowest * x.powi(order));
        let label = Some(format!("slope {order}"));
        self.curve(label, vec![line(first), line(last)], Stroke::Dashed, GREY);
    }

    /// The curve's finite points in the coordinates of the axes.
    fn mapped(&self, curve: &Curve) -> Vec<(f64, f64)> {
        curve
            .points
            .iter()
            .map(|&(x, y)| (self.x.scale.map(x), self.y.scale.map(y)))
            .filter(|(x, y)| x.is_finite() && y.is_finite())
            .collect()
    }

    /// How many entries of the legend fit side by side under a panel of that width.
    fn legend_columns(&self, width: f64) -> usize {
        const MARGINS: f64 = 70.0;
        const MARKER: f64 = 34.0;
        const LETTER: f64 = 6.0;
        let labels = self.curves.iter().filter_map(|curve| curve.label.as_ref());
        let longest = labels
            .map(|label| label.chars().count())
            .max()
            .unwrap_or_default();
        let column = MARKER + LETTER * longest as f64;
        ((width - MARGINS) / column).floor().max(1.0) as usize
    }

    fn layout(&self, plots: &[Plot], data: &[Vec<(f64, f64)>], width: f64) -> Layout {
        let xs = range(data.iter().flatten().map(|p| p.0), self.x.scale);
        let ys = range(data.iter().flatten().map(|p| p.1), self.y.scale);
        let mut layout = Layout::auto_from_plots(plots)
            .with_title(self.title.clone())
            .with_x_label(self.x.label.clone())
            .with_y_label(self.y.label.clone())
            .with_x_tick_format(self.x.scale.tick_format())
            .with_y_tick_format(self.y.scale.tick_format())
            .with_x_axis_min(xs.0)
            .with_x_axis_max(xs.1)
            .with_y_axis_min(ys.0)
            .with_y_axis_max(ys.1)
            .with_title_size(15)
            .with_label_size(13)
            .with_tick_size(11)
            .with_body_size(11)
            .with_legend_box(false)
            .with_box_axes();
        layout = layout
            .with_x_tick_step(tick_step(xs, self.x.scale))
            .with_y_tick_step(tick_step(ys, self.y.scale));
        match self.legend {
            Legend::None => layout.show_legend = false,
            Legend::Below => {
                layout.show_legend = true;
                layout = layout
                    .with_legend_position(LegendPosition::OutsideBottomColumns)
                    .with_legend_col_limit(self.legend_columns(width));
            }
        }
        if self.equal_aspect {
            layout = layout.with_equal_aspect();
        }
        layout
    }
}

/// The range of an axis: the values with a margin, whole decades or octaves for a logarithm.
fn range(values: impl Iterator<Item = f64>, scale: Scale) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    if !(low.is_finite() && high.is_finite()) {
        return (0.0, 1.0);
    }
    match scale {
        Scale::Linear if high > low => {
            let margin = 0.05 * (high - low);
            (low - margin, high + margin)
        }
        Scale::Linear => (low - 1.0, high + 1.0),
        Scale::Decades => (low.floor(), high.ceil().max(low.floor() + 1.0)),
        Scale::Octaves => (low - 0.5, high + 0.5),
    }
}

/// The distance of ticks: 1, 2 or 5 times a power of ten, whole for a logarithm.
fn tick_step((low, high): (f64, f64), scale: Scale) -> f64 {
    let raw = (high - low) / 6.0;
    let power = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= raw)
        .unwrap_or(raw);
    match scale {
        Scale::Linear => step,
        Scale::Decades | Scale::Octaves => step.max(1.0).ceil(),
    }
}

/// A picture.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    /// Its title.
    pub title: String,
    /// Its panels, row by row.
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
    /// Width and height of a panel.
    pub panel_size: (f64, f64),
}

impl Picture {
    /// A picture of one row.
    pub fn row(title: impl Into<String>, panels: Vec<Panel>) -> Self {
        Self {
            title: title.into(),
            columns: panels.len().max(1),
            panels,
            panel_size: (460.0, 400.0),
        }
    }

    /// Draws the picture and writes it to `path`.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, path: &Path, format: Format) -> io::Result<()> {
        let columns = self.columns.max(1);
        let rows = self.panels.len().div_ceil(columns);
        let mut plots = Vec::new();
        let mut layouts = Vec::new();
        for panel in &self.panels {
            let data: Vec<_> = panel
                .curves
                .iter()
                .map(|curve| panel.mapped(curve))
                .collect();
            let curves = panel.curves.iter().zip(&data);
            let drawn: Vec<Plot> = curves.flat_map(|(curve, data)| draw(curve, data)).collect();
            layouts.push(panel.layout(&drawn, &data, self.panel_size.0));
            plots.push(drawn);
        }
        let scene = Figure::new(rows.max(1), columns)
            .with_plots(plots)
            .with_layouts(layouts)
            .with_title(self.title.clone())
            .with_title_size(17)
            .with_cell_size(self.panel_size.0, self.panel_size.1)
            .render();
        let bytes = match format {
            Format::Svg => SvgBackend::default().render_scene(&scene).into_bytes(),
            Format::Png => PngBackend::new()
                .with_scale(PNG_SCALE)
                .render_scene(&scene)
                .map_err(io::Error::other)?,
        };
        std::fs::write(path, bytes)
    }
}

fn draw(curve: &Curve, data: &[(f64, f64)]) -> Vec<Plot> {
    let line = |width: f64| {
        LinePlot::new()
            .with_data(data.to_vec())
            .with_color(curve.colour)
            .with_stroke_width(width)
    };
    let dots = |size: f64| {
        ScatterPlot::new()
            .with_data(data.to_vec())
            .with_color(curve.colour)
            .with_size(size)
    };
    let label_line = |line: LinePlot| match &curve.label {
        Some(label) => line.with_legend(label.clone()),
        None => line,
    };
    let label_dots = |dots: ScatterPlot| match &curve.label {
        Some(label) => dots.with_legend(label.clone()),
        None => dots,
    };
    match curve.stroke {
        Stroke::Solid => vec![label_line(line(1.5)).into()],
        Stroke::Thin => vec![label_line(line(0.8)).into()],
        Stroke::Dashed => vec![label_line(line(1.5).with_dashed()).into()],
        Stroke::Dots => vec![label_dots(dots(2.5)).into()],
        Stroke::Fine => vec![label_dots(dots(0.8)).into()],
        Stroke::Marked => vec![label_line(line(1.5)).into(), dots(3.5).into()],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_raised() {
        assert_eq!(superscript(-10), "⁻¹⁰");
        assert_eq!(superscript(3), "³");
    }

    #[test]
    fn ticks_are_round_and_few() {
        assert_eq!(tick_step((0.0, 100.0), Scale::Linear), 20.0);
        assert_eq!(tick_step((-0.7, 0.9), Scale::Linear), 0.5);
        assert_eq!(tick_step((-3.0, -1.0), Scale::Decades), 1.0);
        assert_eq!(tick_step((-16.0, 0.0), Scale::Decades), 5.0);
    }

    #[test]
    fn writes_both_formats() {
        let mut panel = Panel::new(
            "errors",
            Axis::new("step size τ", Scale::Octaves),
            Axis::new("error", Scale::Decades),
        );
        let points = (4..9)
            .map(|k| 0.5f64.powi(k))
            .map(|tau| (tau, tau * tau))
            .collect();
        panel.curve(Some("scheme".into()), points, Stroke::Marked, COLOURS[0]);
        panel.slope(2, 0);
        assert_eq!(panel.curves.len(), 2);
        let directory = tempfile::tempdir().unwrap();
        let picture = Picture::row("a test", vec![panel]);
        for (format, start) in [(Format::Svg, &b"<"[..]), (Format::Png, &b"\x89PNG"[..])] {
            let path = directory
                .path()
                .join(format!("test.{}", format.extension()));
            picture.write(&path, format).unwrap();
            let bytes = std::fs::read(&path).unwrap();
            assert!(bytes.starts_with(start) && bytes.len() > 1000);
        }
    }
}
