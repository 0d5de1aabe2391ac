//! All mistakes are shown at once, and what uses the system gives no further errors.

use dmm_runtime::pws;

pws! {
    system Everything {
        state x, y;
        param k = 1, unused = 2;
        const c = 1/0;
        interface wall = zz;
        region right where wall > 0 {
            der(x) = log(y) + qq;
            der(x) = 1;
        }
        region left where wall < 0 {
            der(x) = sin(x, y);
            der(y) = k * c;
            conserved energy = ln(-1);
        }
    }
}

fn states<const N: usize, S: dmm_runtime::System<N>>(system: &S) -> &'static [&'static str] {
    system.metadata().states
}

fn main() {
    let system = Everything { k: 2.0, ..Default::default() };
    let names: &[&str] = states(&system);
    println!("{system:?} {names:?} {:?}", EverythingRegion::Right);
}
