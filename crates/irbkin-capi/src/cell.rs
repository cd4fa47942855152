//! Cells of boxes.

use core::ffi::c_char;

use irbkin::pose;
use irbkin_motion::body::Shape;
use irbkin_motion::cell::Cell;

use crate::arguments::{slice, text};
use crate::fault::{Fault, IrbkinCode, guarded};
use crate::handle::{IrbkinCell, free, give};

/// An obstacle that is a box.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct IrbkinBox {
    /// Its name; no two boxes of a cell have the same.
    pub name: *const c_char,
    /// Lengths of its edges [m].
    pub size: [f64; 3],
    /// The pose of its center in the world, a 4x4 matrix by rows.
    pub pose: [f64; 16],
}

/// Make a cell of `count` boxes, from which an arm is to stay at least `margin` [m].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_cell_of_boxes(
    boxes: *const IrbkinBox,
    count: usize,
    margin: f64,
    made: *mut *mut IrbkinCell,
) -> IrbkinCode {
    let named = |(index, one): (usize, &IrbkinBox)| {
        // SAFETY: the name is as the header says.
        let name = unsafe { text("boxes[].name", one.name) }?.to_owned();
        let pose = pose::from_rows(&one.pose).map_err(Fault::item("boxes", index))?;
        let shape = Shape::cuboid(one.size, &pose).map_err(Fault::item("boxes", index))?;
        Ok((name, shape))
    };
    let new = || {
        // SAFETY: the pointers are as the header says.
        let boxes = unsafe { slice("boxes", boxes, count) }?;
        let boxes = boxes.iter().enumerate().map(named).collect::<Result<_, Fault>>()?;
        Ok(IrbkinCell::new(Cell::new(boxes, margin)?))
    };
    // SAFETY: as above.
    guarded(|| unsafe { give("made", made, new) })
}

/// Free a cell; NULL does nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn irbkin_cell_free(cell: *mut IrbkinCell) {
    // SAFETY: the pointer is as the header says.
    guarded(|| unsafe { free("cell", cell) });
}
