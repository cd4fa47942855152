//! List the instruction sets of this processor that irbkin has kernels for, narrowest first.

use irbkin::InstructionSet;

fn main() {
    for set in InstructionSet::available() {
        println!("{}", set.name());
    }
}
