#![allow(clippy::unwrap_used, missing_docs)]
use irbkin::*;
#[test]
fn ur() {
    let lim = [[0.3292312135682257, 0.4045884988008262], [2.478116763687867, 2.62205425789258], [-2.0771671755272596, -1.9079998305619639], [3.023982707745193, 3.2719586425973564], [2.950190697825755, 3.3365764763123082], [-4.965991068081652, -4.691061214352105]];
    let q = [0.40208860953503756, 2.6213704088452, -1.9177433908234252, 3.046818933699697, 3.141592652589793, -4.928574074720809];
    let r: Robot<6> = Robot::named("UR3").unwrap();
    let r = r.with_limits(JointLimits::new(lim).unwrap());
    let t = r.fk(&q);
    for s in r.ik(&t).unwrap().iter() { println!("{:?} {:?} {:?} {} res {:?}", s.q, s.status, s.free, s.slot, r.residual(&s.q, &t)); 
      if s.free.is_some() { for v in [-4.9, -4.928574074720809, 1.35] { let m = r.with_free(&t, s, v); println!("   {v} {:?} {:?}", m, m.clone().ok().flatten().map(|m| r.residual(&m.q, &t))); } } }
    println!("{:?}", r.singularity(&q));
    println!("{:?}", r.ik_nearest(&t, &q, &[1.0;6]));
    println!("{:?}", r.ik_nearest(&t, &q.map(|q| q+0.05), &[1.0;6]));
}
