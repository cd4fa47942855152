% UNTESTED: never run. All solutions of a pose in MATLAB, with a C compiler that `mex -setup` knows.
% target/capi is the folder of `make capi`; name the library as it is named there.
prefix = 'target/capi';
library = fullfile(prefix, 'lib', 'libirbkin.so');
if ~libisloaded('irbkin')
    loadlibrary(library, fullfile(prefix, 'include', 'irbkin.h'), 'alias', 'irbkin');
end

robot = libpointer('IrbkinRobotPtr');
code = calllib('irbkin', 'irbkin_robot_named', 'IRB 2600-12/1.65', robot);
check(code);

% By rows, as C has them: MATLAB's matrices are by columns.
pose = [1 0 0 0.85; 0 -1 0 0.32; 0 0 -1 0.64; 0 0 0 1]';
dof = calllib('irbkin', 'irbkin_robot_dof', robot);
slots = calllib('irbkin', 'irbkin_robot_slot_count', robot);
q = libpointer('doublePtr', zeros(1, slots * dof));
status = libpointer('uint8Ptr', zeros(1, slots, 'uint8'));
found = libpointer('uint64Ptr', 0);
code = calllib('irbkin', 'irbkin_ik', robot, pose(:), [], q, slots * dof, status, slots, found);
check(code);

solutions = reshape(q.Value, dof, slots)';  % a row in each slot [rad], NaN where it is empty
disp(rad2deg(solutions(bitand(status.Value, 1) > 0, :)))

calllib('irbkin', 'irbkin_robot_free', robot);
clear robot
unloadlibrary('irbkin')

function check(code)
    if ~(isequal(code, 0) || isequal(code, 'IRBKIN_CODE_OK'))
        error('irbkin:refused', '%s', calllib('irbkin', 'irbkin_last_error'));
    end
end
