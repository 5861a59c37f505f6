//! Random signals: a servo on a coordinate, an engine that lags behind its characteristic, a force by waves and tables.

use super::dice::Dice;
use super::draft::Draft;

/// Kinds of signal-driven effects that are drawn.
const MACHINES: [&str; 4] = ["servo", "engine", "force", "sum"];
/// Kinds of signals that depend on time. The ramp is listed twice, since it occurs nowhere else.
const WAVES: [&str; 9] =
    ["sine", "chirp", "spline", "linear", "hold", "step", "ramp", "ramp", "product"];

impl Draft {
    /// Adds an effect that is driven by signals, with a probability of 0.3.
    pub(crate) fn steer(&mut self, dice: &mut Dice) {
        if !dice.chance(0.3) {
            return;
        }
        let effect = match MACHINES[dice.below(MACHINES.len())] {
            "servo" => self.servo(dice),
            "engine" => self.engine(dice),
            "sum" => self.on_sum(dice),
            _ => Some(self.pushed(dice)),
        };
        if let Some(text) = effect {
            self.blocks.push(format!("[[effect]]\nname = \"steered\"\n{text}"));
        }
    }

    /// Adds a signal and returns its name. With `has_rate` the signal's rate is an output.
    fn signal(&mut self, text: String, has_rate: bool) -> String {
        let name = format!("s{}", self.signals.len());
        self.signals.push((text, has_rate));
        name
    }

    /// Draws a coordinate without a guide: its keys as text, its unit, its inertia and whether it is an angle.
    fn free_coordinate(&self, dice: &mut Dice) -> Option<(String, f64, f64)> {
        let list = self.coordinates(&[]);
        // a thin rod has no inertia about its own line, on which a force might act
        let has_rod =
            |j: usize| self.links[j].bodies.iter().flatten().any(|&b| self.bodies[b].rod.is_some());
        let is_free = |j: usize| self.links[j].guide.is_none() && !has_rod(j);
        let free: Vec<_> = list.iter().filter(|c| is_free(c.0)).collect();
        if free.is_empty() {
            return None;
        }
        let (joint, number, unit) = *free[dice.below(free.len())];
        let slides = self.links[joint].kind.coordinates(self.planar)[0];
        let turns = number >= slides;
        let l2 = 0.1 * self.length * self.length;
        let inertia = self.mass * if turns { l2 } else { 1.0 };
        Some((format!("joint = \"j{joint}\"\ncoordinate = {number}"), unit, inertia))
    }

    fn servo(&mut self, dice: &mut Dice) -> Option<String> {
        let (of, unit, inertia) = self.free_coordinate(dice)?;
        let frequency = dice.logarithmic(0.5, 3.0);
        self.stiffest = self.stiffest.max(frequency);
        let w = frequency / self.time;
        let (p, d) = (inertia * w * w, inertia * w * dice.between(0.2, 1.0));
        let i = if dice.chance(0.6) { 0.3 * p * w } else { 0.0 };
        let measured = self.signal(format!("kind = \"measure\"\n{of}"), true);
        let target = self.smooth(dice, 0.5 * unit);
        let limit = if dice.chance(0.4) {
            format!("\nlimit = {:?}", p * unit * dice.between(0.1, 1.0))
        } else {
            String::new()
        };
        let servo = self.signal(
            format!(
                "kind = \"pid\"\ntarget = \"{target}\"\nmeasured = \"{measured}\"\np = {p:?}\ni = {i:?}\nd = {d:?}{limit}"
            ),
            false,
        );
        Some(format!("kind = \"torque\"\n{of}\nsignal = \"{servo}\""))
    }

    /// Draws a torque that falls with a rate, and follows it with a delay.
    fn engine(&mut self, dice: &mut Dice) -> Option<String> {
        let (of, unit, inertia) = self.free_coordinate(dice)?;
        let (rate, torque) = (unit / self.time, inertia * unit / (self.time * self.time));
        let measured = self.signal(format!("kind = \"measure\"\n{of}\nquantity = \"rate\""), false);
        let mut size = |share: f64| torque * share * dice.between(0.5, 1.0);
        let curve = format!(
            "kind = \"curve\"\nof = \"{measured}\"\ntable = [[{:?}, {:?}], [0.0, {:?}], [{:?}, {:?}]]",
            -4.0 * rate,
            size(0.6),
            size(0.5),
            4.0 * rate,
            size(-0.5)
        );
        let asked = self.signal(curve, false);
        let delay = self.time * dice.between(0.2, 1.0);
        let lag = self.signal(format!("kind = \"lag\"\nof = \"{asked}\"\ntime = {delay:?}"), true);
        let limits = [-0.3, 0.4].map(|x| x * torque);
        let held = format!(
            "kind = \"clamp\"\nof = \"{lag}\"\nlower = {:?}\nupper = {:?}",
            limits[0], limits[1]
        );
        let held = self.signal(held, true);
        let sum = format!("kind = \"sum\"\nof = [\"{held}\", \"{lag}\"]\nfactors = [1.0, 0.2]");
        let sum = self.signal(sum, true);
        Some(format!("kind = \"torque\"\n{of}\nsignal = \"{sum}\""))
    }

    /// Draws an effect on a sum of two coordinates, or of a coordinate and a length.
    fn on_sum(&mut self, dice: &mut Dice) -> Option<String> {
        let (one, unit, inertia) = self.free_coordinate(dice)?;
        let (two, other, _) = self.free_coordinate(dice)?;
        let factor = dice.between(-1.5, 1.5) * unit / other;
        let body = dice.below(self.bodies.len());
        let second = if dice.chance(0.6) || self.bodies[body].rod.is_some() {
            format!("{{ {}, factor = {factor:?} }}", two.replace('\n', ", "))
        } else {
            let [a, b] = [None, Some(body)].map(|b| (b, self.point(dice, b)));
            let [a, b] = [a, b].map(|(body, at)| {
                let at = super::write::vector(at, self.planar);
                format!("{{ body = \"{}\", at = {at} }}", super::write::name(body))
            });
            format!("{{ points = [{a}, {b}], factor = {:?} }}", 0.5 * unit / self.length)
        };
        let curve = if dice.chance(0.3) { ", coefficients = [0.0, 1.0, 0.2]" } else { "" };
        let terms = format!("terms = [{{ {}{curve} }}, {second}]", one.replace('\n', ", "));
        let frequency = dice.logarithmic(0.5, 3.0);
        self.stiffest = self.stiffest.max(frequency);
        let w = frequency / self.time;
        let (k, c) = (inertia * w * w, inertia * w * dice.between(0.0, 0.5));
        let law = match dice.below(3) {
            0 => {
                let free = unit * dice.between(-0.5, 0.5);
                format!(
                    "kind = \"torsion-spring\"\nstiffness = {k:?}\ndamping = {c:?}\nfree_value = {free:?}"
                )
            }
            1 => format!("kind = \"torque\"\nvalue = {:?}", k * unit * dice.between(-0.5, 0.5)),
            _ => format!(
                "kind = \"limit\"\nlower = {:?}\nupper = {:?}\nstiffness = {k:?}\ndamping = {c:?}",
                -0.3 * unit,
                0.2 * unit
            ),
        };
        Some(format!("{law}\n{terms}"))
    }

    /// Draws a force on a body, with a signal for each component.
    fn pushed(&mut self, dice: &mut Dice) -> String {
        let body = dice.below(self.bodies.len());
        let at = self.point(dice, Some(body));
        let unit = self.mass * self.length / (self.time * self.time);
        let n = if self.planar { 2 } else { 3 };
        let names: Vec<String> = (0..n).map(|_| self.wave(dice, unit)).collect();
        format!(
            "kind = \"force\"\nbody = \"b{body}\"\nat = {}\nsignal = {names:?}",
            super::write::vector(at, self.planar)
        )
    }

    /// Draws a signal that is twice differentiable.
    pub(super) fn smooth(&mut self, dice: &mut Dice, size: f64) -> String {
        let (amplitude, time) = (size * dice.between(0.2, 1.0), self.time);
        let text = if dice.chance(0.5) {
            format!(
                "kind = \"sine\"\namplitude = {amplitude:?}\nfrequency = {:?}\noffset = {:?}",
                dice.between(0.05, 0.3) / time,
                size * dice.between(-0.5, 0.5)
            )
        } else {
            let (at, rise) = (time * dice.between(0.0, 1.0), time * dice.between(1.0, 3.0));
            format!("kind = \"step\"\nto = {amplitude:?}\nat = {at:?}\nrise = {rise:?}")
        };
        self.signal(text, true)
    }

    fn wave(&mut self, dice: &mut Dice, unit: f64) -> String {
        let time = self.time;
        let mut size = || unit * dice.between(-1.0, 1.0);
        let sizes = [size(), size(), size(), size()];
        let (f, g) = (dice.between(0.05, 0.4) / time, dice.between(0.05, 0.4) / time);
        let start = time * dice.between(0.0, 1.0);
        let text = match WAVES[dice.below(WAVES.len())] {
            "sine" => format!(
                "kind = \"sine\"\namplitude = {:?}\nfrequency = {f:?}\nphase = 0.4\noffset = {:?}",
                sizes[0], sizes[1]
            ),
            "chirp" => format!(
                "kind = \"chirp\"\namplitude = {:?}\nfrequency = {f:?}\nto_frequency = {g:?}\nduration = {:?}",
                sizes[0],
                3.0 * time
            ),
            "step" => format!(
                "kind = \"step\"\nfrom = {:?}\nto = {:?}\nat = {start:?}",
                sizes[0], sizes[1]
            ),
            "ramp" => format!(
                "kind = \"ramp\"\nrate = {:?}\nstart = {start:?}\nend = {:?}",
                sizes[0] / time,
                start + time
            ),
            "product" => {
                let one = self.smooth(dice, unit);
                let two = self.smooth(dice, 1.0);
                format!("kind = \"product\"\nof = [\"{one}\", \"{two}\"]")
            }
            how => {
                let repeats = how != "spline" && dice.chance(0.4);
                // the last value of a periodic table is its first one
                let size = |i: usize| if repeats && i == 3 { sizes[0] } else { sizes[i] };
                let row = |i: usize| format!("[{:?}, {:?}]", 0.7 * i as f64 * time, size(i));
                let rows: Vec<String> = (0..4).map(row).collect();
                format!(
                    "kind = \"table\"\ntable = [{}]\ninterpolation = \"{how}\"\nperiodic = {repeats}",
                    rows.join(", ")
                )
            }
        };
        self.signal(text, true)
    }
}
