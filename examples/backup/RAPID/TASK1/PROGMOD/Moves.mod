%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Moves
    ! Work object on the positioner STN_1: its place follows from eax_a.
    PERS wobjdata wStn:=[FALSE,FALSE,"STN_1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    CONST robtarget pStn1:=[[200,0,150],[0.707107,0.707107,0,0],[-1,0,1,0],[0,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pStn2:=[[200,0,150],[0.707107,0.707107,0,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    PROC GoPos(robtarget pTo,speeddata vTo,zonedata zTo,PERS tooldata tTo,PERS wobjdata wTo)
        IF zTo.finep THEN
            MoveL pTo,vTo,fine,tTo\WObj:=wTo;
        ELSE
            MoveJ pTo,vTo,zTo,tTo\WObj:=wTo;
        ENDIF
    ENDPROC

    PROC rStation()
        MoveJ pStn1,v500,fine,tGun\WObj:=wStn;
        ! The target before gives eax_a, this one does not.
        MoveL pStn2,v100,fine,tGun\WObj:=wStn;
    ENDPROC
ENDMODULE
