%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE MainModule
    ! Robot 1: welds on a fixture and on a positioner.
    CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pHome:=[[1500,0,1400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pApp1:=[[100,100,200],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pSeam1:=[[100,100,20],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pSeam2:=[[100,500,20],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pNear:=[[100,500,20.02],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pArcVia:=[[200,600,20],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pArcLine:=[[200,500,20],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pArcEnd:=[[300,500,20],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    ! Wrong quarter of axis 1, a quarter's edge missed by 0.4 deg, out of reach, a quaternion of
    ! norm 1.05.
    CONST robtarget pWrong:=[[350,300,50],[0,0,1,0],[1,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pEdge:=[[1697.22,301.357,805.344],[0.042476,0.002125,0.999042,0.010302],[0,-1,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pFar:=[[4200,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pNorm:=[[1500,200,1300],[0,0,1.05,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pUnused:=[[1500,0,1200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST pose peUp:=[[0,0,2500],[1,0,0,0]];

    PROC main()
        MoveAbsJ jHome,v1000,fine,tGun;
        rSeam;
        ! Corner path failure: a zone before a wait.
        MoveL pApp1,v500,z20,tGun\WObj:=wFix;
        WaitDI diReady,1;
        rArcs;
        rFaults;
        ! The seam 2.5 m higher: out of reach, in a routine that the displacement reaches.
        PDispSet peUp;
        rSeam;
        PDispOff;
        rStation;
        IF FALSE THEN
            MoveL pFar,v500,fine,tGun;
        ENDIF
        MoveJ pHome,v1000,fine,tGun;
    ENDPROC

    PROC rSeam()
        GoPos pApp1,v1000,z20,tGun,wFix;
        GoPos pSeam1,v200,fine,tGun,wFix;
        MoveL pSeam2,v20,z0,tGun\WObj:=wFix;
        ! 0.02 mm from the target before.
        MoveL pNear,v20,fine,tGun\WObj:=wFix;
    ENDPROC

    PROC rArcs()
        MoveJ pSeam2,v500,fine,tGun\WObj:=wFix;
        MoveC pArcVia,pArcEnd,v50,z1,tGun\WObj:=wFix;
        MoveJ pSeam2,v500,fine,tGun\WObj:=wFix;
        ! Three points of a line determine no circle.
        MoveC pArcLine,pArcEnd,v50,fine,tGun\WObj:=wFix;
    ENDPROC

    PROC rFaults()
        MoveJ pWrong,v500,fine,tGun\WObj:=wFix;
        MoveJ pEdge,v500,fine,tGun;
        MoveJ pNorm,v500,fine,tGun;
        ! Its own procedure takes it out of reach.
        GoPos pFar,v500,fine,tGun,wobj0;
        ! tGum is not declared.
        MoveJ pHome,v500,fine,tGum;
    ENDPROC

    PROC rNobodyCalls()
        MoveJ pHome,v1000,fine,tGun;
    ENDPROC
ENDMODULE
