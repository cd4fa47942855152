%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE MainModule
    ! Robot 2: on the track TRACK_2, which eax_a moves.
    PERS tooldata tGun:=[TRUE,[[0,0,250],[1,0,0,0]],[8,[0,0,90],[1,0,0,0],0,0,0]];
    CONST robtarget pAbove:=[[1200,4700,1000],[0,0,1,0],[-1,0,0,0],[1500,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pPick:=[[1200,4700,700],[0,0,1,0],[-1,0,0,0],[1500,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pPlace:=[[3200,4600,600],[0,0,1,0],[-1,0,0,0],[3200,9E9,9E9,9E9,9E9,9E9]];
    ! Axis 2 at -80 deg: inside the catalog's limits, outside the limits in force.
    CONST robtarget pBack:=[[2700,3791.97,1452.28],[0.40558,-0.579228,0.579228,0.40558],[0,0,0,0],[3200,9E9,9E9,9E9,9E9,9E9]];
    ! The track is 2 m away from where this one is in reach.
    CONST robtarget pWrongTrack:=[[3200,4600,900],[0,0,1,0],[-1,0,0,0],[0,9E9,9E9,9E9,9E9,9E9]];

    PROC main()
        MoveJ pAbove,v1000,z50,tGun;
        MoveL pPick,v200,fine,tGun;
        MoveL pAbove,v500,z50,tGun;
        MoveJ pPlace,v1000,fine,tGun;
        MoveJ pBack,v1000,fine,tGun;
        MoveJ pWrongTrack,v1000,fine,tGun;
        rUnload;
    ENDPROC
ENDMODULE
