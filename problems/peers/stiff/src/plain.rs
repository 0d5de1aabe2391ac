//! The same problems as an integrator of smooth fields asks for them: f, ∂f/∂x and, of the block on
//! a belt, three phases with the functions whose roots end them.

use crate::problems::{Hires, Robertson, Stick, VanDerPol};

/// A problem from t = 0.
pub trait Plain<const N: usize> {
    /// What decides between the fields.
    type Phase: Copy + Default + PartialEq;

    const INITIAL: [f64; N];
    const T_END: f64;
    /// The state at `T_END`.
    const END: [f64; N];
    /// What absolute tolerances of the components are relative to: the largest sizes that they have had,
    /// rounded.
    const SIZES: [f64; N];
    /// How often the phase changes.
    const CHANGES: u64 = 0;
    /// The number of functions whose roots end a phase.
    const ROOTS: usize = 0;

    fn field(phase: Self::Phase, x: &[f64; N]) -> [f64; N];

    /// By rows.
    fn jacobian(phase: Self::Phase, x: &[f64; N]) -> [[f64; N]; N];

    /// The functions whose roots end a phase.
    fn roots(_phase: Self::Phase, _x: &[f64; N]) -> [f64; 2] {
        [1.0; 2]
    }

    /// The phase after a root, which begins with the state as it is left here.
    fn next(phase: Self::Phase, _x: &mut [f64; N]) -> Self::Phase {
        phase
    }
}

impl Plain<3> for Robertson {
    type Phase = ();
    const INITIAL: [f64; 3] = [1.0, 0.0, 0.0];
    const T_END: f64 = 1e11;
    const END: [f64; 3] = [
        2.083_340_149_701_255e-8,
        8.333_360_770_334_713e-14,
        0.999_999_979_166_505,
    ];
    const SIZES: [f64; 3] = [1.0, 3.6e-5, 1.0];

    fn field((): (), &[a, b, c]: &[f64; 3]) -> [f64; 3] {
        let (first, second, third) = (0.04 * a, 3e7 * b * b, 1e4 * b * c);
        [third - first, first - third - second, second]
    }

    fn jacobian((): (), &[_, b, c]: &[f64; 3]) -> [[f64; 3]; 3] {
        [
            [-0.04, 1e4 * c, 1e4 * b],
            [0.04, -1e4 * c - 6e7 * b, -1e4 * b],
            [0.0, 6e7 * b, 0.0],
        ]
    }
}

impl Plain<8> for Hires {
    type Phase = ();
    const INITIAL: [f64; 8] = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0057];
    const T_END: f64 = 321.8122;
    const END: [f64; 8] = [
        0.737_131_257_332_566_8e-3,
        0.144_248_572_631_618_5e-3,
        0.588_872_974_096_757_5e-4,
        0.117_565_134_328_314_9e-2,
        0.238_635_619_883_133_1e-2,
        0.623_896_825_274_279_6e-2,
        0.284_999_839_518_576_9e-2,
        0.285_000_160_481_423_1e-2,
    ];
    const SIZES: [f64; 8] = [1.0, 0.15, 0.04, 0.37, 0.29, 0.7, 0.0057, 0.0057];

    fn field((): (), y: &[f64; 8]) -> [f64; 8] {
        let bound = 280.0 * y[5] * y[7];
        [
            -1.71 * y[0] + 0.43 * y[1] + 8.32 * y[2] + 0.0007,
            1.71 * y[0] - 8.75 * y[1],
            -10.03 * y[2] + 0.43 * y[3] + 0.035 * y[4],
            8.32 * y[1] + 1.71 * y[2] - 1.12 * y[3],
            -1.745 * y[4] + 0.43 * y[5] + 0.43 * y[6],
            -bound + 0.69 * y[3] + 1.71 * y[4] - 0.43 * y[5] + 0.69 * y[6],
            bound - 1.81 * y[6],
            -bound + 1.81 * y[6],
        ]
    }

    fn jacobian((): (), y: &[f64; 8]) -> [[f64; 8]; 8] {
        let (by_5, by_7) = (280.0 * y[7], 280.0 * y[5]);
        [
            [-1.71, 0.43, 8.32, 0.0, 0.0, 0.0, 0.0, 0.0],
            [1.71, -8.75, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, -10.03, 0.43, 0.035, 0.0, 0.0, 0.0],
            [0.0, 8.32, 1.71, -1.12, 0.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, -1.745, 0.43, 0.43, 0.0],
            [0.0, 0.0, 0.0, 0.69, 1.71, -by_5 - 0.43, 0.69, -by_7],
            [0.0, 0.0, 0.0, 0.0, 0.0, by_5, -1.81, by_7],
            [0.0, 0.0, 0.0, 0.0, 0.0, -by_5, 1.81, -by_7],
        ]
    }
}

impl Plain<2> for VanDerPol {
    type Phase = ();
    const INITIAL: [f64; 2] = [2.0, 0.0];
    const T_END: f64 = 2.0;
    const END: [f64; 2] = [1.706_167_732_170_483, -0.892_809_701_024_797_5];
    // of the slow motions; between them |y| is up to about 4/(3ε)
    const SIZES: [f64; 2] = [2.0, 1.0];

    fn field((): (), &[x, y]: &[f64; 2]) -> [f64; 2] {
        [y, ((1.0 - x * x) * y - x) / 1e-6]
    }

    fn jacobian((): (), &[x, y]: &[f64; 2]) -> [[f64; 2]; 2] {
        [
            [0.0, 1.0],
            [(-2.0 * x * y - 1.0) / 1e-6, (1.0 - x * x) / 1e-6],
        ]
    }
}

/// How the block moves beside the belt.
#[derive(Clone, Copy, Default, PartialEq)]
pub enum Block {
    #[default]
    Slower,
    Held,
    Faster,
}

const SPEED: f64 = 0.2;
const FORCE: f64 = 0.4;

/// What friction has to balance to hold the block.
fn pull(z: f64) -> f64 {
    0.3 * SPEED - z
}

impl Plain<3> for Stick {
    type Phase = Block;
    const INITIAL: [f64; 3] = [0.0; 3];
    const T_END: f64 = 30.0;
    // by its flows in 60 digits
    const END: [f64; 3] = [0.227_417_124_502_650_66, 0.2, 0.227_415_124_502_650_67];
    const SIZES: [f64; 3] = [0.65, 0.32, 0.65];
    const CHANGES: u64 = 9;
    const ROOTS: usize = 2;

    fn field(phase: Block, &[x, v, z]: &[f64; 3]) -> [f64; 3] {
        let acceleration = match phase {
            Block::Slower => 0.3 * v - z + FORCE,
            Block::Held => 0.0,
            Block::Faster => 0.3 * v - z - FORCE,
        };
        [v, acceleration, (x - z) / 1e-5]
    }

    fn jacobian(phase: Block, _: &[f64; 3]) -> [[f64; 3]; 3] {
        let of_acceleration = match phase {
            Block::Held => [0.0; 3],
            Block::Slower | Block::Faster => [0.0, 0.3, -1.0],
        };
        [[0.0, 1.0, 0.0], of_acceleration, [1e5, 0.0, -1e5]]
    }

    fn roots(phase: Block, &[_, v, z]: &[f64; 3]) -> [f64; 2] {
        match phase {
            Block::Held => [pull(z) - FORCE, pull(z) + FORCE],
            Block::Slower | Block::Faster => [v - SPEED, 1.0],
        }
    }

    fn next(phase: Block, x: &mut [f64; 3]) -> Block {
        x[1] = SPEED;
        let pull = pull(x[2]);
        if phase != Block::Held && pull.abs() <= FORCE {
            Block::Held
        } else if pull > 0.0 {
            Block::Faster
        } else {
            Block::Slower
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Central differences agree with ∂f/∂x around a state.
    fn assert_derivative<P: Plain<N>, const N: usize>(phase: P::Phase, x: [f64; N]) {
        let jacobian = P::jacobian(phase, &x);
        for k in 0..N {
            let step = 1e-5 * x[k];
            let moved = |by: f64| {
                let mut x = x;
                x[k] += by;
                P::field(phase, &x)
            };
            let (before, after) = (moved(-step), moved(step));
            for i in 0..N {
                let difference = (after[i] - before[i]) / (2.0 * step);
                let size = jacobian[i]
                    .iter()
                    .fold(1.0, |size: f64, it| size.max(it.abs()));
                let error = (difference - jacobian[i][k]).abs();
                assert!(error < 1e-6 * size, "{i} {k}: {difference}");
            }
        }
    }

    #[test]
    fn jacobians_are_derivatives() {
        assert_derivative::<Robertson, 3>((), [0.7, 0.03, 0.2]);
        assert_derivative::<VanDerPol, 2>((), [1.3, -0.8]);
        let y = [0.5, 0.1, 0.03, 0.2, 0.25, 0.4, 0.003, 0.004];
        assert_derivative::<Hires, 8>((), y);
        for phase in [Block::Slower, Block::Held, Block::Faster] {
            assert_derivative::<Stick, 3>(phase, [0.4, 0.3, 0.2]);
        }
    }
}
