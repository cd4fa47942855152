%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE Unload
    CONST robtarget pUnload:=[[3200,4600,800],[0,0,1,0],[-1,0,0,0],[3200,9E9,9E9,9E9,9E9,9E9]];

    PROC rUnload()
        MoveJ pUnload,v1000,fine,tGun;
        ! The rest is loaded at run time.
        Load \Dynamic,diskhome\File:="part.mod";
        %"rPart"%;
    ENDPROC
ENDMODULE
