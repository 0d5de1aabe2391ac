//! The block in which an item stands, which decides what items may stand there.

/// Where an item stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// In the system's block.
    System,
    /// In a region's block.
    Region,
    /// In the block of what holds while a solution slides.
    Sliding,
    /// In as many loops.
    Loop(usize),
}

impl Place {
    /// The number of loops around it.
    pub(super) fn loops(self) -> usize {
        match self {
            Self::System | Self::Region | Self::Sliding => 0,
            Self::Loop(depth) => depth,
        }
    }
}
