//! Pictures: panels of curves with linear or logarithmic axes, written as SVG or PNG.
//!
//! Drawn by `kuva`, whose bitmap back end brings its own font, so that pictures look the same
//! everywhere. A logarithmic axis is drawn as the linear axis of the logarithm, with powers
//! as labels.

mod axis;
mod legend;
mod look;

use std::io;
use std::path::Path;

use kuva::backend::png::PngBackend;
use kuva::backend::svg::SvgBackend;
use kuva::prelude::{Layout, LinePlot, MarkerShape, Plot, ScatterPlot, render_multiple};
use kuva::render::render::{Primitive, Scene, TextAnchor};

pub use axis::{Axis, Scale, superscript};
pub use look::{GREY, LIGHT_GREY, Line, Look, Stroke};

use axis::{range, tick_step};

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

/// A point of a curve at which its line is interrupted.
pub const BREAK: (f64, f64) = (f64::NAN, f64::NAN);

/// A curve.
#[derive(Clone, PartialEq, Debug)]
pub struct Curve {
    /// Its entry in the legend, if it has one.
    pub label: Option<String>,
    /// Where it goes; its line is interrupted at a [`BREAK`].
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub stroke: Stroke,
    /// What tells it from the others.
    pub look: Look,
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
            equal_aspect: false,
        }
    }

    /// Adds a curve.
    pub fn curve(
        &mut self,
        label: Option<String>,
        points: Vec<(f64, f64)>,
        stroke: Stroke,
        look: impl Into<Look>,
    ) {
        self.curves.push(Curve {
            label,
            points,
            stroke,
            look: look.into(),
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
        let look = Look {
            line: Line::Dashed,
            ..GREY.into()
        };
        self.curve(label, vec![line(first), line(last)], Stroke::Solid, look);
    }

    /// The curve's finite points in the coordinates of the axes, piece by piece between breaks.
    fn mapped(&self, curve: &Curve) -> Vec<Vec<(f64, f64)>> {
        let pieces = curve.points.split(|point| point.0.is_nan());
        let map = |&(x, y): &(f64, f64)| (self.x.scale.map(x), self.y.scale.map(y));
        let finite = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite();
        let pieces = pieces.map(|piece| piece.iter().map(map).filter(finite).collect::<Vec<_>>());
        pieces.filter(|piece| !piece.is_empty()).collect()
    }

    fn layout(
        &self,
        plots: &[Plot],
        data: &[Vec<Vec<(f64, f64)>>],
        (width, height): (f64, f64),
    ) -> Layout {
        let points = || data.iter().flatten().flatten();
        let xs = range(points().map(|p| p.0), self.x.scale);
        let ys = range(points().map(|p| p.1), self.y.scale);
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
            .with_box_axes();
        let mut steps = [tick_step(xs, self.x.scale), tick_step(ys, self.y.scale)];
        if self.equal_aspect {
            // the shorter range is drawn as long as the other
            steps = [steps[0].max(steps[1]); 2];
        }
        layout = layout
            .with_x_tick_step(steps[0])
            .with_y_tick_step(steps[1])
            .with_width(width)
            .with_height(height);
        layout.show_legend = false;
        if self.equal_aspect {
            layout = layout.with_equal_aspect();
        }
        layout
    }

    /// The panel without its legend.
    fn scene(&self, size: (f64, f64)) -> Vec<Primitive> {
        let data: Vec<_> = self.curves.iter().map(|curve| self.mapped(curve)).collect();
        let curves = self.curves.iter().zip(&data);
        let mut plots: Vec<Plot> = curves.flat_map(|(curve, data)| draw(curve, data)).collect();
        if plots.is_empty() {
            // axes without a curve
            plots.push(LinePlot::new().into());
        }
        let layout = self.layout(&plots, &data, size);
        render_multiple(plots, layout).elements
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
        let scene = self.scene();
        let bytes = match format {
            Format::Svg => SvgBackend::default().render_scene(&scene).into_bytes(),
            Format::Png => PngBackend::new()
                .with_scale(PNG_SCALE)
                .render_scene(&scene)
                .map_err(io::Error::other)?,
        };
        std::fs::write(path, bytes)
    }

    /// The title, then row by row the panels, each above its legend.
    fn scene(&self) -> Scene {
        let columns = self.columns.max(1);
        let (width, height) = self.panel_size;
        let rows: Vec<&[Panel]> = self.panels.chunks(columns).collect();
        let legends = |row: &&[Panel]| {
            let heights = row.iter().map(|panel| legend::height(&panel.curves, width));
            heights.fold(0.0, f64::max)
        };
        let heights: Vec<f64> = rows.iter().map(|row| height + legends(row) + GAP).collect();
        let total = (
            columns as f64 * (width + GAP) + GAP,
            TITLE_HEIGHT + heights.iter().sum::<f64>(),
        );
        let mut scene = Scene::new(total.0, total.1);
        scene.font_family = Some(FONTS.to_owned());
        scene.add(text(
            &self.title,
            total.0 / 2.0,
            0.7 * TITLE_HEIGHT,
            TITLE_SIZE,
        ));
        let mut y = TITLE_HEIGHT;
        for (row, row_height) in rows.iter().zip(heights) {
            for (column, panel) in row.iter().enumerate() {
                let x = GAP + column as f64 * (width + GAP);
                add(&mut scene, (x, y), panel.scene((width, height)));
                let legend = legend::entries(&panel.curves, width);
                add(&mut scene, (x, y + height), legend);
            }
            y += row_height;
        }
        scene
    }
}

/// Of a picture that has no fonts of its own (SVG).
const FONTS: &str = "DejaVu Sans, Liberation Sans, Arial, sans-serif";
/// Between panels, and around them.
const GAP: f64 = 14.0;
/// Of the picture's title.
const TITLE_HEIGHT: f64 = 34.0;
const TITLE_SIZE: u32 = 17;

/// Centred text.
fn text(content: &str, x: f64, y: f64, size: u32) -> Primitive {
    Primitive::Text {
        x,
        y,
        content: content.to_owned(),
        size,
        anchor: TextAnchor::Middle,
        rotate: None,
        bold: false,
        color: None,
    }
}

/// Adds a part of the picture at its place.
fn add(scene: &mut Scene, (x, y): (f64, f64), part: Vec<Primitive>) {
    scene.add(Primitive::GroupStart {
        transform: Some(format!("translate({x},{y})")),
        title: None,
        extra_attrs: None,
    });
    part.into_iter().for_each(|primitive| scene.add(primitive));
    scene.add(Primitive::GroupEnd);
}

/// The plots of a curve: a line for each piece, the marks of all in one.
fn draw(curve: &Curve, pieces: &[Vec<(f64, f64)>]) -> Vec<Plot> {
    let lines = |width: f64| -> Vec<Plot> {
        let line = |piece: &Vec<(f64, f64)>| -> Plot {
            LinePlot::new()
                .with_data(piece.clone())
                .with_color(&*curve.look.colour)
                .with_line_style(curve.look.line.style())
                .with_stroke_width(width)
                .into()
        };
        pieces.iter().map(line).collect()
    };
    let marks = |size: f64, marker: MarkerShape| -> Vec<Plot> {
        let marks = ScatterPlot::new()
            .with_data(pieces.concat())
            .with_color(&*curve.look.colour)
            .with_marker(marker)
            .with_size(size);
        vec![marks.into()]
    };
    match curve.stroke {
        Stroke::Solid => lines(1.5),
        Stroke::Thin => lines(0.8),
        Stroke::Fine => marks(0.8, MarkerShape::Circle),
        Stroke::Marked => {
            let marks = marks(3.5, MarkerShape::Circle);
            lines(1.5).into_iter().chain(marks).collect()
        }
        Stroke::Circles => marks(5.0, MarkerShape::Circle),
        Stroke::Squares => marks(4.5, MarkerShape::Square),
        Stroke::Crosses => marks(4.0, MarkerShape::Cross),
        Stroke::Triangles => marks(4.0, MarkerShape::Triangle),
        Stroke::Diamonds => marks(4.0, MarkerShape::Diamond),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_interrupted_at_breaks() {
        let axis = || Axis::new("", Scale::Linear);
        let mut panel = Panel::new("", axis(), axis());
        let points = vec![(0.0, 0.0), (1.0, 0.0), BREAK, BREAK, (1.0, 1.0), (2.0, 1.0)];
        panel.curve(None, points, Stroke::Solid, Look::nth(0));
        let pieces = panel.mapped(&panel.curves[0]);
        assert_eq!(pieces, [[(0.0, 0.0), (1.0, 0.0)], [(1.0, 1.0), (2.0, 1.0)]]);
        assert_eq!(draw(&panel.curves[0], &pieces).len(), 2);
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
        panel.curve(Some("scheme".into()), points, Stroke::Marked, Look::nth(0));
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
