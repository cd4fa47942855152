#![allow(missing_docs, clippy::unwrap_used)]
use irbkin::*;
use std::time::Instant;
fn main() {
    let mut s = 1u64;
    let mut u = move || { s ^= s >> 12; s ^= s << 25; s ^= s >> 27; (s.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / 9007199254740992.0 };
    for name in ["IRB 2600-12/1.65", "UR3"] {
        let r: Robot<6> = Robot::named(name).unwrap();
        let qs: Vec<[f64;6]> = (0..2000).map(|_| r.limits().to_array().map(|[l,h]| l + (h-l)*u())).collect();
        let ts: Vec<_> = qs.iter().map(|q| r.fk(q)).collect();
        let mut best = f64::INFINITY; let mut bc = f64::INFINITY;
        for _ in 0..60 {
            let t0 = Instant::now();
            for (t,q) in ts.iter().zip(&qs) { std::hint::black_box(r.ik_nearest(t, q, &[1.0;6]).unwrap()); }
            best = best.min(t0.elapsed().as_nanos() as f64 / 2000.0);
            if name.starts_with("IRB") {
            let t0 = Instant::now();
            for (t,q) in ts.iter().zip(&qs) { std::hint::black_box(r.ik_configured(t, r.configuration(q).unwrap()).unwrap()); }
            bc = bc.min(t0.elapsed().as_nanos() as f64 / 2000.0); }
        }
        println!("{name}: ik_nearest {best:.0} ns, ik_configured {bc:.0} ns");
        // singular
        for (what, f) in [("wrist", 0), ("wrist 1e-8", 1), ("elbow", 2)] {
            let qs: Vec<[f64;6]> = qs.iter().map(|q| { let mut q = *q; match f { 0 => q[4] = 0.0, 1 => q[4] = 1e-8, _ => q[2] = if name == "UR3" {0.0} else {(0.115f64).atan2(0.795) - std::f64::consts::FRAC_PI_2} } q }).collect();
            let ts: Vec<_> = qs.iter().map(|q| r.fk(q)).collect();
            for noise in [0.0, 0.1, 3.0] {
            let t0 = Instant::now();
            for (t,q) in ts.iter().zip(&qs) { let _ = std::hint::black_box(r.ik_nearest(t, &q.map(|q| q + noise * (u()-0.5)), &[1.0;6])); }
            println!("   {what} seed off {noise}: {:.1} us", t0.elapsed().as_nanos() as f64 / 2000.0 / 1e3); }
            let t0 = Instant::now();
            for t in &ts { let _ = std::hint::black_box(r.ik(t)); }
            println!("   {what} ik: {:.1} us", t0.elapsed().as_nanos() as f64 / 2000.0 / 1e3);
        }
    }
}
