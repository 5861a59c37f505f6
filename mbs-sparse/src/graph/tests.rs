//! Orders by approximate minimum degree are the same as those of faer 0.24 (`sparse::linalg::amd::order` with its default control). The
//! hashes below are those of faer's orders for the same graphs.

use super::{Lists, index, minimum_degree, neighbours, ordered_by_amd};

/// A running hash of orders: FNV-1a over the positions.
struct Orders(u64);

impl Orders {
    const NONE: Self = Self(0xCBF2_9CE4_8422_2325);

    fn add(&mut self, place: &[u32]) {
        for byte in place.iter().flat_map(|place| place.to_le_bytes()) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3);
        }
    }

    /// Adds the order of a graph, which is a permutation.
    fn of(&mut self, name: &str, elements: &[Vec<usize>], n_nodes: usize) {
        let mut lists = Lists::with_capacity(elements.len());
        for element in elements {
            lists.items.extend(element.iter().map(|&v| index(v)));
            lists.close();
        }
        let graph = neighbours(&lists, n_nodes);
        let mut place = ordered_by_amd(&graph, n_nodes);
        self.add(&place);
        place.sort_unstable();
        let is_permutation = place.iter().enumerate().all(|(k, &v)| index(k) == v);
        assert!(is_permutation && place.len() == n_nodes, "{name}, {n_nodes} nodes");
    }
}

/// Draws a number below `n`, by xorshift64*.
fn draw(state: &mut u64, n: usize) -> usize {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % n
}

/// Returns `n_elements` elements of up to `largest` nodes each. The nodes of an element are within a distance `reach` of its first node.
fn random(
    state: &mut u64,
    n: usize,
    n_elements: usize,
    [largest, reach]: [usize; 2],
) -> Vec<Vec<usize>> {
    let element = |state: &mut u64| {
        let first = draw(state, n);
        let size = 1 + draw(state, largest);
        let mut nodes: Vec<usize> =
            (0..size).map(|_| (first + draw(state, reach.min(n))) % n).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    };
    (0..n_elements).map(|_| element(state)).collect()
}

fn pairs(all: impl Iterator<Item = (usize, usize)>) -> Vec<Vec<usize>> {
    all.map(|(a, b)| vec![a, b]).collect()
}

#[test]
fn orders_of_random_graphs_are_those_of_another_program() {
    let mut orders = Orders::NONE;
    let mut state = 0x9E37_79B9_7F4A_7C15;
    for n in (1..60).chain([97, 200, 431, 1000, 2000]) {
        for share in [0, 1, 2, 5] {
            for shape in [[2, n], [2, 4], [4, 10], [12, 30], [6, n], [3, 40]] {
                // with half as many elements as nodes, some parts remain unconnected
                let elements = random(&mut state, n, n * share / 2, shape);
                orders.of(&format!("random {share} {shape:?}"), &elements, n);
            }
        }
    }
    assert_eq!(orders.0, 0x1397_389E_B621_1455);
}

#[test]
fn orders_of_dense_rows_are_those_of_another_program() {
    let mut orders = Orders::NONE;
    let mut state = 7;
    for n in [20, 50, 150, 400, 1200] {
        for n_dense in [1, 2, 5] {
            let mut elements = random(&mut state, n, n, [4, 12]);
            for _ in 0..n_dense {
                let hub = draw(&mut state, n);
                elements.extend(pairs((0..n).filter(|&v| v != hub).map(|v| (hub, v))));
            }
            orders.of(&format!("{n_dense} dense rows"), &elements, n);
        }
    }
    assert_eq!(orders.0, 0x3088_BF0B_D865_0B19);
}

#[test]
fn orders_of_regular_graphs_are_those_of_another_program() {
    let mut orders = Orders::NONE;
    let mut state = 11;
    orders.of("nothing", &[], 0);
    for n in [1, 2, 3, 7, 15, 16, 17, 18, 33, 120, 341, 700] {
        orders.of("no edges", &[], n);
        orders.of("clique", &[(0..n).collect()], n);
        orders.of("star", &pairs((1..n).map(|v| (0, v))), n);
        orders.of("star, hub last", &pairs((1..n).map(|v| (v - 1, n - 1))), n);
        orders.of("chain", &pairs((1..n).map(|v| (v - 1, v))), n);
        orders.of("ring", &pairs((0..n).filter(|_| n > 2).map(|v| (v, (v + 1) % n))), n);
        orders.of("tree of two", &pairs((1..n).map(|v| (v, (v - 1) / 2))), n);
        orders.of("random tree", &pairs((1..n).map(|v| (v, draw(&mut state, v)))), n);
        let blocks = (0..n).step_by(5).map(|v| (v..(v + 7).min(n)).collect());
        orders.of("chain of cliques", &blocks.collect::<Vec<_>>(), n);
    }
    for (w, h) in [(2, 2), (3, 50), (7, 7), (20, 31), (44, 44)] {
        let across = (0..h).flat_map(|y| (1..w).map(move |x| (y * w + x - 1, y * w + x)));
        let down = (1..h).flat_map(|y| (0..w).map(move |x| ((y - 1) * w + x, y * w + x)));
        orders.of("grid", &pairs(across.chain(down)), w * h);
        let cells = (1..h).flat_map(|y| (1..w).map(move |x| y * w + x));
        let cells = cells.map(|v| vec![v - w - 1, v - w, v - 1, v]);
        orders.of("grid of cells", &cells.collect::<Vec<_>>(), w * h);
    }
    assert_eq!(orders.0, 0x2218_8B73_13A0_BDBD);
}

#[test]
fn the_order_of_a_long_chain_is_that_of_another_program() {
    let n = 100_000;
    let mut elements = Lists::with_capacity(n);
    for v in 0..n - 3 {
        elements.items.extend([v, v + 1, v + 3].map(index));
        elements.close();
    }
    let mut orders = Orders::NONE;
    orders.add(&minimum_degree(&elements, n));
    assert_eq!(orders.0, 0x6E5B_1AB8_C821_9751);
}
