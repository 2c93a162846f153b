# A cam and its follower: the velocity of the material point of the cam, and that of the contact.
restart: with(MBSymba_r6):
cam := rotate('Z', alpha(t)):
set_frame_name(cam, 'CAM'):
follower := translate(0, y(t), 0):
C := make_POINT(follower, 0, 0, 0):
V__c := velocity(C);
V__m := frame_frozen_velocity(C, cam):
sliding := project(V__c, ground) - V__m:
show(sliding, 'synthetic');
comp_XYZ(V__m);
comp('XY', sliding, cam);
