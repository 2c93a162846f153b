//! Textbook forms, derived from unsimplified products of rotation matrices.

use symbody_core::vector::{self, Vector3};
use symbody_core::{Assumption, Error, Function, Graph, Id, Number};

type Result<T> = std::result::Result<T, Error>;

/// A rotation matrix, by rows.
type Rotation = [Vector3; 3];

struct Model {
    g: Graph,
}

impl Model {
    fn new() -> Self {
        Self { g: Graph::new() }
    }

    fn symbols<const N: usize>(&mut self, names: [&str; N]) -> [Id; N] {
        names.map(|name| self.g.symbol(name, Assumption::Real))
    }

    fn coordinates<const N: usize>(&mut self, names: [&str; N]) -> [Id; N] {
        names.map(|name| self.g.time_function(name, 0).expect("few derivatives"))
    }

    /// The rotation about the axis x, y or z (0, 1, 2).
    fn rotation(&mut self, axis: usize, angle: Id) -> Result<Rotation> {
        let (sin, cos) = (self.g.apply(Function::Sin, &[angle])?, self.g.apply(Function::Cos, &[angle])?);
        let mut rows = [[Id::ZERO; 3]; 3];
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        rows[axis][axis] = Id::ONE;
        (rows[u][u], rows[v][v]) = (cos, cos);
        rows[u][v] = self.g.neg(sin);
        rows[v][u] = sin;
        Ok(rows)
    }

    fn apply(&mut self, r: &Rotation, v: Vector3) -> Result<Vector3> {
        let mut out = [Id::ZERO; 3];
        for (component, row) in out.iter_mut().zip(r) {
            *component = vector::dot(&mut self.g, *row, v)?;
        }
        Ok(out)
    }

    fn transpose(r: &Rotation) -> Rotation {
        std::array::from_fn(|i| std::array::from_fn(|j| r[j][i]))
    }

    fn compose(&mut self, a: &Rotation, b: &Rotation) -> Result<Rotation> {
        let columns = Self::transpose(b);
        let mut out = [[Id::ZERO; 3]; 3];
        for (column, b) in columns.iter().enumerate() {
            let product = self.apply(a, *b)?;
            for row in 0..3 {
                out[row][column] = product[row];
            }
        }
        Ok(out)
    }

    fn velocity(&mut self, position: Vector3) -> Result<Vector3> {
        let derivative = self.g.time_derivatives(&position)?;
        Ok([derivative[0], derivative[1], derivative[2]])
    }

    /// The angular velocity in local axes, from R^T R'.
    fn angular_velocity(&mut self, r: &Rotation) -> Result<Vector3> {
        let entries: Vec<Id> = r.concat();
        let rates = self.g.time_derivatives(&entries)?;
        let rate: Rotation = std::array::from_fn(|i| std::array::from_fn(|j| rates[3 * i + j]));
        let skew = self.compose(&Self::transpose(r), &rate)?;
        Ok([skew[2][1], skew[0][2], skew[1][0]])
    }

    fn half(&mut self, factor: Id, square: Id) -> Result<Id> {
        let half = self.g.number(&Number::rational(1, 2));
        let product = self.g.mul(factor, square)?;
        self.g.mul(half, product)
    }

    /// m v.v / 2
    fn energy_of_motion(&mut self, mass: Id, position: Vector3) -> Result<Id> {
        let v = self.velocity(position)?;
        let square = vector::dot(&mut self.g, v, v)?;
        self.half(mass, square)
    }

    /// The energy of rotation with principal moments of inertia.
    fn energy_of_rotation(&mut self, moments: Vector3, r: &Rotation) -> Result<Id> {
        let omega = self.angular_velocity(r)?;
        let mut sum = Id::ZERO;
        for (moment, rate) in moments.into_iter().zip(omega) {
            let square = self.g.mul(rate, rate)?;
            let term = self.half(moment, square)?;
            sum = self.g.add(sum, term);
        }
        Ok(sum)
    }

    /// The derivative of the energy by the rates of two coordinates.
    fn mass(&mut self, energy: Id, a: &str, b: &str) -> Result<Id> {
        let rates = [a, b].map(|name| self.g.time_function(name, 1).expect("few derivatives"));
        let first = self.g.diff(energy, rates[0])?;
        self.g.diff(first, rates[1])
    }

    /// Simplify, check the value and the cost, and print.
    fn simplified(&mut self, id: Id) -> Result<String> {
        let simple = self.g.simplify(id)?;
        assert_eq!(self.g.value(simple), self.g.value(id));
        assert!(self.g.cost(&[simple]).total() <= self.g.cost(&[id]).total());
        assert_eq!(self.g.simplify(simple)?, simple, "not settled: {}", self.g.to_text(simple));
        Ok(self.g.to_text(simple))
    }
}

/// The energy of two bars in a plane; the second angle absolute or relative.
fn two_bars(model: &mut Model, angles: [Id; 2], lengths: [Id; 3], masses: [Id; 2]) -> Result<Id> {
    let [l1, lc1, lc2] = lengths;
    let first = model.rotation(2, angles[0])?;
    let second = model.rotation(2, angles[1])?;
    let elbow = model.apply(&first, [l1, Id::ZERO, Id::ZERO])?;
    let center = model.apply(&first, [lc1, Id::ZERO, Id::ZERO])?;
    let along = model.apply(&second, [lc2, Id::ZERO, Id::ZERO])?;
    let tip = vector::add(&mut model.g, elbow, along);
    let (t1, t2) = (model.energy_of_motion(masses[0], center)?, model.energy_of_motion(masses[1], tip)?);
    Ok(model.g.add(t1, t2))
}

#[test]
fn double_pendulum() -> Result<()> {
    let m = &mut Model::new();
    let angles = m.coordinates(["theta1", "theta2"]);
    let [m1, m2, l1, l2] = m.symbols(["m1", "m2", "l1", "l2"]);
    let energy = two_bars(m, angles, [l1, l1, l2], [m1, m2])?;
    let entry = m.mass(energy, "theta1", "theta2")?;
    assert_eq!(m.simplified(entry)?, "l1*l2*m2*cos(theta1 - theta2)");
    let entry = m.mass(energy, "theta1", "theta1")?;
    assert_eq!(m.simplified(entry)?, "(m1 + m2)*l1**2");
    Ok(())
}

#[test]
fn two_link_arm() -> Result<()> {
    let m = &mut Model::new();
    let [q1, q2] = m.coordinates(["q1", "q2"]);
    let [m1, m2, l1, lc1, lc2, i1, i2] = m.symbols(["m1", "m2", "l1", "lc1", "lc2", "I1", "I2"]);
    let sum = m.g.add(q1, q2);
    let motion = two_bars(m, [q1, sum], [l1, lc1, lc2], [m1, m2])?;
    let (first, second) = (m.rotation(2, q1)?, m.rotation(2, q2)?);
    let second = m.compose(&first, &second)?;
    let spin1 = m.energy_of_rotation([Id::ZERO, Id::ZERO, i1], &first)?;
    let spin2 = m.energy_of_rotation([Id::ZERO, Id::ZERO, i2], &second)?;
    let energy = m.g.add(motion, spin1);
    let energy = m.g.add(energy, spin2);
    let entry = m.mass(energy, "q1", "q1")?;
    assert_eq!(m.simplified(entry)?, "I1 + I2 + m1*lc1**2 + m2*(l1**2 + lc2**2 + 2*l1*lc2*cos(q2))");
    let entry = m.mass(energy, "q1", "q2")?;
    assert_eq!(m.simplified(entry)?, "I2 + lc2*m2*(lc2 + l1*cos(q2))");
    let entry = m.mass(energy, "q2", "q2")?;
    assert_eq!(m.simplified(entry)?, "I2 + m2*lc2**2");
    Ok(())
}

#[test]
fn spherical_pendulum() -> Result<()> {
    let m = &mut Model::new();
    let [phi, theta] = m.coordinates(["phi", "theta"]);
    let [mass, l] = m.symbols(["m", "l"]);
    let (turn, tilt) = (m.rotation(2, phi)?, m.rotation(1, theta)?);
    let frame = m.compose(&turn, &tilt)?;
    let bob = m.apply(&frame, [Id::ZERO, Id::ZERO, l])?;
    let energy = m.energy_of_motion(mass, bob)?;
    let entry = m.mass(energy, "phi", "phi")?;
    assert_eq!(m.simplified(entry)?, "m*l**2*sin(theta)**2");
    let entry = m.mass(energy, "phi", "theta")?;
    assert_eq!(entry, Id::ZERO);
    assert_eq!(m.simplified(energy)?, "m*l**2*(theta'**2 + sin(theta)**2*phi'**2)/2");
    Ok(())
}

#[test]
fn cart_pole() -> Result<()> {
    let m = &mut Model::new();
    let [x, theta] = m.coordinates(["x", "theta"]);
    let [cart, mass, l] = m.symbols(["M", "m", "l"]);
    let swing = m.rotation(2, theta)?;
    let down = m.g.neg(l);
    let arm = m.apply(&swing, [Id::ZERO, down, Id::ZERO])?;
    let bob = vector::add(&mut m.g, [x, Id::ZERO, Id::ZERO], arm);
    let (t1, t2) = (m.energy_of_motion(cart, [x, Id::ZERO, Id::ZERO])?, m.energy_of_motion(mass, bob)?);
    let energy = m.g.add(t1, t2);
    for (a, b, textbook) in
        [("x", "x", "M + m"), ("x", "theta", "l*m*cos(theta)"), ("theta", "theta", "m*l**2")]
    {
        let entry = m.mass(energy, a, b)?;
        assert_eq!(m.simplified(entry)?, textbook);
    }
    Ok(())
}

#[test]
fn heavy_top() -> Result<()> {
    let m = &mut Model::new();
    let [phi, theta, psi] = m.coordinates(["phi", "theta", "psi"]);
    let [i1, i3] = m.symbols(["I1", "I3"]);
    let (a, b, c) = (m.rotation(2, phi)?, m.rotation(0, theta)?, m.rotation(2, psi)?);
    let frame = m.compose(&a, &b)?;
    let frame = m.compose(&frame, &c)?;
    let energy = m.energy_of_rotation([i1, i1, i3], &frame)?;
    for (a, b, textbook) in [
        ("phi", "phi", "I1*sin(theta)**2 + I3*cos(theta)**2"),
        ("phi", "psi", "I3*cos(theta)"),
        ("theta", "theta", "I1"),
        ("psi", "psi", "I3"),
    ] {
        let entry = m.mass(energy, a, b)?;
        assert_eq!(m.simplified(entry)?, textbook);
    }
    let entry = m.mass(energy, "phi", "theta")?;
    assert_eq!(entry, Id::ZERO);
    assert_eq!(
        m.simplified(energy)?,
        "(I1*(theta'**2 + sin(theta)**2*phi'**2) + I3*(psi' + cos(theta)*phi')**2)/2"
    );
    Ok(())
}

#[test]
fn bead_on_a_rotating_hoop() -> Result<()> {
    let m = &mut Model::new();
    let [theta] = m.coordinates(["theta"]);
    let [mass, radius, omega] = m.symbols(["m", "R", "Omega"]);
    let time = m.g.time();
    let angle = m.g.mul(omega, time)?;
    let (turn, tilt) = (m.rotation(2, angle)?, m.rotation(1, theta)?);
    let frame = m.compose(&turn, &tilt)?;
    let bead = m.apply(&frame, [Id::ZERO, Id::ZERO, radius])?;
    let energy = m.energy_of_motion(mass, bead)?;
    assert_eq!(m.simplified(energy)?, "m*R**2*(theta'**2 + Omega**2*sin(theta)**2)/2");
    let entry = m.mass(energy, "theta", "theta")?;
    assert_eq!(m.simplified(entry)?, "m*R**2");
    Ok(())
}

/// Three Euler angles in each of several ways, general moments: the classical result for z-x-z.
#[test]
fn rigid_body_in_euler_angles() -> Result<()> {
    let m = &mut Model::new();
    let angles = m.coordinates(["phi", "theta", "psi"]);
    let moments = m.symbols(["A", "B", "C"]);
    for axes in [[2, 0, 2], [2, 1, 0], [0, 1, 2], [1, 0, 1]] {
        let (a, b, c) = (
            m.rotation(axes[0], angles[0])?,
            m.rotation(axes[1], angles[1])?,
            m.rotation(axes[2], angles[2])?,
        );
        let frame = m.compose(&a, &b)?;
        let frame = m.compose(&frame, &c)?;
        let energy = m.energy_of_rotation(moments, &frame)?;
        let text = m.simplified(energy)?;
        let simple = m.g.simplify(energy)?;
        // T = (A p^2 + B q^2 + C r^2)/2 with the three rates of Euler's kinematic equations.
        assert!(m.g.cost(&[simple]).total() <= 23, "{} {text}", m.g.cost(&[simple]).total());
    }
    Ok(())
}

#[test]
fn three_bars_in_a_plane_with_relative_angles() -> Result<()> {
    let m = &mut Model::new();
    let angles = m.coordinates(["q1", "q2", "q3"]);
    let [mass, l1, l2, l3] = m.symbols(["m", "l1", "l2", "l3"]);
    let mut frame = m.rotation(2, angles[0])?;
    let mut tip = m.apply(&frame, [l1, Id::ZERO, Id::ZERO])?;
    for (angle, length) in [(angles[1], l2), (angles[2], l3)] {
        let turn = m.rotation(2, angle)?;
        frame = m.compose(&frame, &turn)?;
        let bar = m.apply(&frame, [length, Id::ZERO, Id::ZERO])?;
        tip = vector::add(&mut m.g, tip, bar);
    }
    let energy = m.energy_of_motion(mass, tip)?;
    let entry = m.mass(energy, "q1", "q3")?;
    assert_eq!(m.simplified(entry)?, "l3*m*(l3 + l1*cos(q2 + q3) + l2*cos(q3))");
    let entry = m.mass(energy, "q1", "q1")?;
    assert_eq!(
        m.simplified(entry)?,
        "m*(l1**2 + l2**2 + l3**2 + 2*l1*(l2*cos(q2) + l3*cos(q2 + q3)) + 2*l2*l3*cos(q3))"
    );
    Ok(())
}

/// d/dt dT/dq' - dT/dq + dV/dq
fn lagrange(m: &mut Model, kinetic: Id, potential: Id, coordinate: &str) -> Result<Id> {
    let (q, rate) = (m.g.time_function(coordinate, 0)?, m.g.time_function(coordinate, 1)?);
    let momentum = m.g.diff(kinetic, rate)?;
    let inertia = m.g.time_derivative(momentum)?;
    let lagrangian = m.g.sub(kinetic, potential);
    let force = m.g.diff(lagrangian, q)?;
    Ok(m.g.sub(inertia, force))
}

#[test]
fn equations_of_motion_are_as_short_as_in_the_books() -> Result<()> {
    let m = &mut Model::new();
    let [theta1, theta2, phi, theta, x] = m.coordinates(["theta1", "theta2", "phi", "theta", "x"]);
    let [m1, m2, l1, l2, mass, l, cart, g] = m.symbols(["m1", "m2", "l1", "l2", "m", "l", "M", "g"]);

    let kinetic = two_bars(m, [theta1, theta2], [l1, l1, l2], [m1, m2])?;
    let (s1, s2) = (m.g.apply(Function::Sin, &[theta1])?, m.g.apply(Function::Sin, &[theta2])?);
    let (h1, along) = (m.g.mul(l1, s1)?, m.g.mul(l2, s2)?);
    let h2 = m.g.add(h1, along);
    let (w1, w2) = (m.g.mul(m1, h1)?, m.g.mul(m2, h2)?);
    let weight = m.g.add(w1, w2);
    let potential = m.g.mul(g, weight)?;
    // l1*((m1 + m2)*(l1*theta1'' + g*c1) + l2*m2*(theta2''*cos(d) + theta2'**2*sin(d))), d = theta1 - theta2
    assert_length(m, (kinetic, potential), "theta1", 18)?;
    // l2*m2*(l2*theta2'' + g*c2 + l1*(theta1''*cos(d) - theta1'**2*sin(d)))
    assert_length(m, (kinetic, potential), "theta2", 15)?;

    let (turn, tilt) = (m.rotation(2, phi)?, m.rotation(1, theta)?);
    let frame = m.compose(&turn, &tilt)?;
    let bob = m.apply(&frame, [Id::ZERO, Id::ZERO, l])?;
    let kinetic = m.energy_of_motion(mass, bob)?;
    let weight = m.g.mul(mass, g)?;
    let potential = m.g.mul(weight, bob[2])?;
    let potential = m.g.neg(potential);
    // l**2*m*s*(phi''*s + 2*phi'*theta'*c) and l*m*(l*theta'' + s*(g - l*phi'**2*c))
    assert_length(m, (kinetic, potential), "phi", 11)?;
    assert_length(m, (kinetic, potential), "theta", 11)?;

    let swing = m.rotation(2, theta)?;
    let down = m.g.neg(l);
    let arm = m.apply(&swing, [Id::ZERO, down, Id::ZERO])?;
    let bob = vector::add(&mut m.g, [x, Id::ZERO, Id::ZERO], arm);
    let (t1, t2) = (m.energy_of_motion(cart, [x, Id::ZERO, Id::ZERO])?, m.energy_of_motion(mass, bob)?);
    let kinetic = m.g.add(t1, t2);
    let potential = m.g.mul(weight, bob[1])?;
    // (M + m)*x'' + l*m*(theta''*c - theta'**2*s) and l*m*(l*theta'' + x''*c + g*s)
    assert_length(m, (kinetic, potential), "x", 11)?;
    assert_length(m, (kinetic, potential), "theta", 9)
}

fn assert_length(
    m: &mut Model,
    (kinetic, potential): (Id, Id),
    coordinate: &str,
    textbook: u64,
) -> Result<()> {
    let residual = lagrange(m, kinetic, potential, coordinate)?;
    let simple = m.g.simplify(residual)?;
    let (cost, text) = (m.g.cost(&[simple]).total(), m.g.to_text(simple));
    assert_eq!(m.g.value(simple), m.g.value(residual));
    assert!(cost <= textbook, "{coordinate}: {cost} operations: {text}");
    Ok(())
}

#[test]
fn whole_numbers_come_out_and_no_fraction_stays_inside() -> Result<()> {
    let m = &mut Model::new();
    let [x, y] = m.symbols(["x", "y"]);
    let (four, six) = (m.g.integer(4), m.g.integer(6));
    let (left, right) = (m.g.mul(four, x)?, m.g.mul(six, y)?);
    let sum = m.g.add(left, right);
    let factored = m.g.factor_terms(sum)?;
    assert_eq!(m.g.to_text(factored), "2*(2*x + 3*y)");
    let half = m.g.number(&Number::rational(1, 2));
    let (cos, two) = (m.g.apply(Function::Cos, &[x])?, m.g.integer(2));
    let square = m.g.mul(cos, cos)?;
    let inner = m.g.sub(half, square);
    let product = m.g.mul(y, inner)?;
    let product = m.g.mul(two, product)?;
    let text = m.simplified(product)?;
    assert!(!text.contains('/'), "{text}");
    Ok(())
}
