//! Drawn couplings, compared with the velocities at their contact points, which an independent reference computes from places and
//! axes alone.

use mbs_core::scene::{BodyId, CouplingMeasure};
use mbs_testkit::machines::kinds::{COUPLED, machine};
use mbs_testkit::machines::{Ways, Wording, twists};
use mbs_testkit::{Random, scene};

#[test]
fn parts_of_what_is_drawn_do_not_slip_where_they_touch() {
    let mut random = Random::new(22);
    for k in 0..750 {
        let machine = machine(&mut random, k % COUPLED);
        let wording = Wording::new(&mut random, &machine, Ways::ALL);
        let body = |name: &str, _| {
            format!(
                "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [0, 0, 0]\ninertia = [1, 1, 1, 0, 0, 0]\n"
            )
        };
        let text = wording.parts(&machine, body);
        let scene = scene(&format!("[scene]\ndimension = 3\nduration = 1.0\n{text}"));
        let mut factor = None;
        for _ in 0..6 {
            let rates: Vec<f64> = machine.joints.iter().map(|_| random.next()).collect();
            let known = twists(&machine.joints, &rates);
            let of = |body: &str| known.iter().find(|(name, _)| *name == body).expect("a body").1;
            let slip = (machine.slip)(&of);
            // the same rates, in the coordinates of the scene file
            let rate = |joint: usize| {
                let name = &scene.joints[joint].name;
                let place = machine.joints.iter().position(|joint| joint.name == name);
                wording.sense(name) * rates[place.expect("a joint")]
            };
            let moving = |(body, at): &(BodyId, [f64; 3])| {
                let name = body.index().map_or("ground", |body| &scene.bodies[body].name);
                let at = wording.back(*at);
                (at, of(name).at(at))
            };
            let measured = |of: &CouplingMeasure<f64>| match of {
                CouplingMeasure::Length { points } => {
                    let ([from, v], [to, w]) =
                        (moving(&points[0]).into(), moving(&points[1]).into());
                    let way: [f64; 3] = core::array::from_fn(|i| to[i] - from[i]);
                    let growth: f64 = (0..3).map(|i| way[i] * (w[i] - v[i])).sum();
                    growth / way.iter().map(|x| x * x).sum::<f64>().sqrt()
                }
                of => rate(of.coordinate().expect("a coordinate").0.index()),
            };
            let terms = scene.couplings[0].terms.iter();
            let sum: f64 = terms.map(|term| term.factor * measured(&term.of)).sum();
            let scale: f64 = *factor.get_or_insert(slip / sum);
            assert!(
                (slip - scale * sum).abs() < 1e-9 * (1.0 + slip.abs()),
                "{}: {slip} and {sum}, {:?}",
                machine.what,
                scene.couplings[0]
            );
        }
    }
}
